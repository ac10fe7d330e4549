// variant.h.
#include "tools/converge/variant.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"
#include "tools/lab/measure.h"

namespace octolux {
namespace {

bool parse_gather(const std::string& text) {
  if (text != "on" && text != "off") {
    throw Error("--gather " + text + ": expected on or off");
  }
  return text == "on";
}

/// The kernel's choices over the settings' other ones.
void set_kernel(EstimatorConfig& estimator, const std::string& kernel) {
  const EstimatorConfig chosen = parse_lab_kernel(kernel).config;
  estimator.kernel = chosen.kernel;
  estimator.octants = chosen.octants;
  estimator.correction = chosen.correction;
}

class Builder {
 public:
  Builder(const VariantChoices& choices, const RenderConfig& settings)
      : choices_(choices), settings_(settings) {}

  void add_path() {
    Variant variant{"path", settings_};
    variant.config.integrator = Integrator::path;
    add(std::move(variant));
  }
  void add_photon() {
    for (const std::string& gather : choices_.gathers) {
      for (const std::int64_t photons : counts()) {
        for (const std::string& kernel : choices_.kernels) add_photon(kernel, photons, gather);
      }
    }
  }
  std::vector<Variant> result() { return std::move(variants_); }

 private:
  std::vector<std::int64_t> counts() const {
    return choices_.photons.empty() ? std::vector<std::int64_t>{settings_.photons.global}
                                    : choices_.photons;
  }
  void add_photon(const std::string& kernel, std::int64_t photons, const std::string& gather) {
    Variant variant{kernel, settings_};
    variant.config.integrator = Integrator::photon;
    variant.config.photons.global = photons;
    variant.config.eye.gather = parse_gather(gather);
    set_kernel(variant.config.estimator, kernel);
    if (choices_.photons.size() > 1) variant.name += fmt::format(", {} photons", photons);
    if (choices_.gathers.size() > 1) variant.name += ", gather " + gather;
    add(std::move(variant));
  }
  /// Leaves out what is there already.
  void add(Variant variant) {
    check(variant.config);
    const bool known = std::any_of(variants_.begin(), variants_.end(),
                                   [&](const Variant& v) { return v.name == variant.name; });
    if (!known) variants_.push_back(std::move(variant));
  }

  const VariantChoices& choices_;
  const RenderConfig& settings_;
  std::vector<Variant> variants_;
};

}  // namespace

std::vector<Variant> make_variants(const VariantChoices& choices, const RenderConfig& settings) {
  Builder builder(choices, settings);
  for (const std::string& integrator : choices.integrators) {
    if (integrator == "photon") {
      builder.add_photon();
    } else if (integrator == "path") {
      builder.add_path();
    } else {
      throw Error(unknown_name("integrator", integrator, {"photon", "path"}));
    }
  }
  return builder.result();
}

}  // namespace octolux
