// xml_extras.h: the table. Mitsuba 0.6 warns about parameters that no plug-in asks for, Mitsuba 3
// refuses them; we refuse all but these, so that a slip of the pen is found.
#include "renderer/xml_extras.h"

#include <string>

namespace octolux {
namespace {

struct Extra {
  const char* tag;   // "" for any
  const char* type;  // "" for any
  const char* name;  // snake_case
  const char* why;
};

constexpr const char* kVariable = "the range of a variable scene; the file's value stands";
constexpr const char* kSmooth = "the plug-in is smooth; a rough one is called 'rough...'";
constexpr const char* kMethod = "how the picture is computed is this program's choice";

constexpr Extra kExtras[] = {
    // "Active Exploration for Neural Global Illumination of Variable Scenes" (Diolatzis 2022)
    {"", "", "min_bounds", kVariable},
    {"", "", "range_bounds", kVariable},
    {"", "", "num_parameters", kVariable},
    // "Practical Path Guiding" branches
    {"bsdf", "", "use_path_guiding", kMethod},
    // Left in by hand when a rough plug-in was changed to a smooth one; 0.6 only warned
    {"bsdf", "conductor", "alpha", kSmooth},
    {"bsdf", "dielectric", "alpha", kSmooth},
    {"bsdf", "thindielectric", "alpha", kSmooth},
    {"bsdf", "plastic", "alpha", kSmooth},
    // Rainbow's path tracer
    {"integrator", "path", "delta", kMethod},
    {"integrator", "path", "sample_num", kMethod},
};

bool matches(const char* wanted, const std::string& name) { return *wanted == 0 || name == wanted; }

}  // namespace

void ignore_extras(Properties& properties, SceneBuilder& builder) {
  const std::string& tag = properties.node().tag;
  for (const Extra& extra : kExtras) {
    if (!matches(extra.tag, tag) || !matches(extra.type, properties.type())) continue;
    if (!properties.take(extra.name)) continue;
    builder.warn_once(extra.name, properties.where(extra.name),
                      std::string("'") + extra.name + "' is ignored: " + extra.why);
  }
}

}  // namespace octolux
