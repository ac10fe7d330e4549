// <integrator>: only what changes the converged picture is taken over, the longest path and
// whether lights are seen. How the picture is computed is this program's own choice.
#include <algorithm>
#include <iterator>

#include "renderer/xml_objects.h"

namespace octolux {
namespace {

/// Unbiased, or wrappers round one that is: any correct renderer gives the same picture.
constexpr const char* kExact[] = {"path",   "volpath", "volpath_simple", "volpathmis", "direct",
                                  "moment", "aov",     "bdpt",           "ptracer",    "adaptive"};

/// What Mitsuba's exact integrators have besides: how the work is split, sampled and watched.
void ignore_method(Properties& properties) {
  properties.ignore({"rr_depth", "strict_normals", "samples_per_pass", "block_size", "timeout"});
  properties.ignore({"shading_samples", "emitter_samples", "luminaire_samples", "bsdf_samples"});
  properties.ignore({"light_image", "sample_direct", "max_error", "p_value", "max_sample_factor"});
  properties.ignore({"aovs", "hide_environment", "use_nee", "use_mis", "use_spectral_mis"});
}

}  // namespace

void read_integrator(Properties& properties, SceneBuilder& builder) {
  Scene& scene = builder.scene();
  const std::string& type = properties.type();
  const bool exact = std::find(std::begin(kExact), std::end(kExact), type) != std::end(kExact);
  if (!exact) {
    builder.warn(properties.node().where,
                 "the integrator '" + type + "' is replaced by this program's own");
  }
  if (type == "direct") scene.max_depth = 2;
  if (const std::optional<int> depth = properties.integer("max_depth")) {
    if (*depth != -1 && *depth < 1) {
      properties.fail("max_depth", "'max_depth' must be -1 (no limit) or at least 1");
    }
    scene.max_depth = *depth;
  }
  if (const std::optional<bool> hide = properties.boolean("hide_emitters")) {
    scene.hide_emitters = *hide;
  }
  for (const XmlNode* nested : properties.objects("integrator")) {
    Properties inner(*nested);
    read_integrator(inner, builder);
  }
  if (!exact) return properties.ignore_rest();
  ignore_method(properties);
  builder.finish(properties);
}

}  // namespace octolux
