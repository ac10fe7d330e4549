// Pixels in an order that keeps near ones together, in parallel.
#pragma once

#include <functional>

namespace octolux {

/// Calls body(x, y) for every pixel, tile by tile, in parallel.
void for_each_pixel(int width, int height, const std::function<void(int x, int y)>& body);

}  // namespace octolux
