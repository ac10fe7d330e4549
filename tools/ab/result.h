// Everything `octolux ab` found, in one structure from which JSON, table, pictures and page are
// made, so that all show the same numbers.
#pragma once

#include <string>
#include <vector>

#include "renderer/render.h"
#include "tools/ab/leaks.h"
#include "tools/ab/masks.h"
#include "tools/ab/plan.h"
#include "tools/compare/comparison.h"

namespace octolux {

/// A picture over one mask.
struct MaskFigures {
  LeakFigures leaks;
  LayerComparison comparison;
};

struct AbPicture {
  AbRender render;
  Progress progress;
  NamedPicture picture;            // root layer and variance
  std::vector<MaskFigures> masks;  // one per mask of the result
};

struct AbResult {
  std::string scene, command;  // the scene's path; what was typed
  std::uint64_t scene_hash = 0;
  NamedPicture reference;
  std::string reference_origin;  // in words
  SeenSurfaces seen;
  std::vector<NamedMask> masks;  // "image" first
  std::vector<AbPicture> pictures;

  int width() const { return reference.file.width; }
  int height() const { return reference.file.height; }
};

/// Fills in the masks and every picture's figures. Throws Error as check_comparable.
void measure(AbResult& result);

}  // namespace octolux
