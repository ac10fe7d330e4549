// plan.h.
#include "tools/ab/plan.h"

#include <algorithm>

#include "core/error.h"
#include "tools/lab/measure.h"

namespace octolux {
namespace {

bool parse_gathering(const std::string& text) {
  if (text != "on" && text != "off") {
    throw Error("--gather: " + unknown_name("gathering", text, {"off", "on"}));
  }
  return text == "on";
}

void refuse_repetition(const std::string& option, std::vector<std::string> names) {
  std::sort(names.begin(), names.end());
  const auto twice = std::adjacent_find(names.begin(), names.end());
  if (twice != names.end()) throw Error(option + " " + *twice + ": given twice");
}

}  // namespace

std::vector<AbRender> plan_renders(const RenderConfig& base,
                                   const std::vector<std::string>& kernels,
                                   const std::vector<std::string>& gatherings) {
  refuse_repetition("--kernel", kernels);
  refuse_repetition("--gather", gatherings);
  std::vector<AbRender> renders;
  for (const std::string& gathering : gatherings) {
    for (const std::string& kernel : kernels) {
      AbRender& r = renders.emplace_back(AbRender{kernel, kernel, base});
      r.config.estimator = parse_lab_kernel(kernel, base.estimator).config;
      r.config.eye.gather = parse_gathering(gathering);
      if (gatherings.size() > 1) r.name += ", gather " + gathering;
      std::replace(r.stem.begin(), r.stem.end(), ':', '-');
      r.stem += "-gather-" + gathering;
    }
  }
  return renders;
}

}  // namespace octolux
