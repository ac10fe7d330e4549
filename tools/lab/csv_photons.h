// Photons and queries from CSV files, so that people can feed the estimators their own cases.
//
// First line: column names, in any order. Photons: x y z (position), nx ny nz (surface normal),
// wx wy wz (towards where the photon came from), r g b (flux). Queries: x y z nx ny nz; further
// columns of that list may be there and are not used. Blank lines and lines starting with # are
// skipped.
#pragma once

#include <string>
#include <vector>

#include "core/photon.h"

namespace octolux {

struct LabPoint {
  Vec3 position, normal;
};

/// Throw Error naming file and line for anything that cannot be read.
std::vector<Photon> read_photon_csv(const std::string& file);
std::vector<LabPoint> read_query_csv(const std::string& file);

}  // namespace octolux
