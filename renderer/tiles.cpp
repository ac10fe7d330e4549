// tiles.h.
#include "renderer/tiles.h"

#include <algorithm>
#include <cstdint>

#include "core/parallel.h"

namespace octolux {

namespace {

constexpr int kTile = 16;  // pixels

}  // namespace

void for_each_pixel(int width, int height, const std::function<void(int x, int y)>& body) {
  const int across = (width + kTile - 1) / kTile, down = (height + kTile - 1) / kTile;
  parallel_for_chunks(static_cast<std::int64_t>(across) * down, 1,
                      [&](std::int64_t tile, std::int64_t, std::int64_t) {
                        const int x0 = static_cast<int>(tile % across) * kTile;
                        const int y0 = static_cast<int>(tile / across) * kTile;
                        for (int y = y0; y < std::min(height, y0 + kTile); ++y) {
                          for (int x = x0; x < std::min(width, x0 + kTile); ++x) body(x, y);
                        }
                      });
}

}  // namespace octolux
