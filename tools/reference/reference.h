// The picture images are measured against, when they are of a scene we can render: an EXR the user
// gives, or one path traced here and kept in a folder by scene hash and film size. A kept one that
// is not good enough is improved, not made anew, and one that was interrupted goes on where it
// stopped. For every verb that needs a truth.
#pragma once

#include <string>

#include "renderer/render.h"
#include "tools/compare/layer_view.h"

namespace octolux {

struct ReferenceOptions {
  std::string file;                           // an EXR; empty: path traced
  std::string folder = "octolux-references";  // of path traced ones; made if need be
  double error = 0.005;  // path traced until its mean relative standard error is this,
  double seconds = 600;  // or for so long, all runs of the program together
};

struct Reference {
  NamedPicture picture;  // root layer, and variance if known; of the film's size
  std::string origin;    // in words, for reports
  bool interrupted = false;
};

/// Throws Error for a file that is no EXR, or whose size is no multiple of the film's; and for a
/// folder that cannot be made. Cheap: call it before long work.
void check_reference(const ReferenceOptions& options, const Scene& scene);

/// `observer` hears of every pass (none, if the reference is there) and may stop them; the result
/// is then what there is so far. Throws Error.
Reference obtain_reference(const ReferenceOptions& options, const Scene& scene,
                           RenderObserver& observer);

/// Averages squares of `factor` pixels, in every layer; `factor` divides the size. The variance is
/// that of the averages, pixels counting as independent.
NamedPicture shrink_picture(const NamedPicture& picture, int factor);

}  // namespace octolux
