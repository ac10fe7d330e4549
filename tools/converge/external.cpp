// external.h.
#include "tools/converge/external.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

#include "core/error.h"

namespace octolux {
namespace {

[[noreturn]] void fail(const std::string& text, const std::string& what) {
  throw Error("--add " + text + ": expected name=seconds:file.exr,seconds:file.exr,...; " + what);
}

TimedPicture parse_item(const std::string& text, const std::string& item) {
  const auto colon = item.find(':');
  TimedPicture picture;
  const char* end = item.data() + std::min(colon, item.size());
  const auto [stop, code] = std::from_chars(item.data(), end, picture.seconds);
  const bool number = code == std::errc() && stop == end;
  if (!number || !(picture.seconds > 0) || !std::isfinite(picture.seconds)) {
    fail(text, "no time above 0 in '" + item + "'");
  }
  if (colon == std::string::npos || colon + 1 == item.size()) {
    fail(text, "no file in '" + item + "'");
  }
  picture.file = item.substr(colon + 1);
  return picture;
}

}  // namespace

External parse_external(const std::string& text) {
  const auto equals = text.find('=');
  if (equals == 0 || equals == std::string::npos) fail(text, "there is no name");
  std::map<double, std::vector<TimedPicture>> by_time;
  std::size_t start = equals + 1;
  while (start <= text.size()) {
    const std::size_t end = std::min(text.find(',', start), text.size());
    const TimedPicture picture = parse_item(text, text.substr(start, end - start));
    by_time[picture.seconds].push_back(picture);
    start = end + 1;
  }
  External external{text.substr(0, equals), {}};
  for (auto& [seconds, pictures] : by_time) external.points.push_back(std::move(pictures));
  return external;
}

void check_external(const External& external, int width, int height) {
  for (const auto& point : external.points) {
    for (const TimedPicture& picture : point) {
      const std::optional<ExrFile> header = exr_header(picture.file);
      if (!header) throw Error(picture.file + ": expected an EXR");
      check_layers(picture.file, {""});
      if (header->width == width && header->height == height) continue;
      throw Error(fmt::format("{}: is {}x{}; expected {}x{} as everything else here", picture.file,
                              header->width, header->height, width, height));
    }
  }
}

}  // namespace octolux
