// How a scene's loading tells how far it is.
#pragma once

#include <functional>

namespace octolux {

/// `what` is being done ("meshes"), `share` in [0, 1] of it is. May be called from several threads
/// at once, and often. May be empty.
using LoadProgress = std::function<void(const char* what, double share)>;

}  // namespace octolux
