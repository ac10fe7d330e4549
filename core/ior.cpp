// Tables of refractive indices; see ior.h.
//
// Transparent materials: Hecht, "Optics", 4th ed., at 589 nm and 0 to 20 degrees Celsius, as in
// Mitsuba's ior.h. Conductors: spectra of the luxpop.com and SOPRA collections (`_palik`: Palik,
// "Handbook of Optical Constants of Solids") that Mitsuba ships, integrated against the CIE 1931
// observer with an equal-energy illuminant, to linear Rec.709; the figures were published with
// Tungsten (ComplexIorData.hpp). Those for silver were checked against Mitsuba 3's own conversion:
// they agree to 1e-4. Negative components, colours outside the gamut, are zero as in Mitsuba 3.
#include "core/ior.h"

#include <algorithm>
#include <cctype>
#include <string_view>

namespace octolux {
namespace {

struct Dielectric {
  std::string_view name;
  float eta;
};

constexpr Dielectric kDielectrics[] = {
    {"vacuum", 1.0f},      {"helium", 1.000036f},        {"hydrogen", 1.000132f},
    {"air", 1.000277f},    {"carbon dioxide", 1.00045f}, {"water", 1.3330f},
    {"acetone", 1.36f},    {"ethanol", 1.361f},          {"carbon tetrachloride", 1.461f},
    {"glycerol", 1.4729f}, {"benzene", 1.501f},          {"silicone oil", 1.52045f},
    {"bromine", 1.661f},   {"water ice", 1.31f},         {"fused quartz", 1.458f},
    {"pyrex", 1.470f},     {"acrylic glass", 1.49f},     {"polypropylene", 1.49f},
    {"bk7", 1.5046f},      {"sodium chloride", 1.544f},  {"amber", 1.55f},
    {"pet", 1.5750f},      {"diamond", 2.419f},
};

/// `palik`: "<name>_palik" is the same data.
struct Conductor {
  std::string_view name;
  bool palik;
  Rgb eta, k;
};

constexpr Conductor kConductors[] = {
    {"none", false, {0, 0, 0}, {1, 1, 1}},
    {"a-C", false, {2.94410f, 2.22715f, 1.96817f}, {0.88743f, 0.79932f, 0.81529f}},
    {"Ag", false, {0.15526f, 0.11672f, 0.13838f}, {4.82834f, 3.12225f, 2.14695f}},
    {"Al", false, {1.65746f, 0.88037f, 0.52123f}, {9.22387f, 6.26952f, 4.83700f}},
    {"AlAs", true, {3.60510f, 3.23294f, 2.21756f}, {0.00067f, 0, 0.00743f}},
    {"AlSb", true, {0, 4.14275f, 4.66977f}, {0, 0.09377f, 1.30074f}},
    {"Au", false, {0.14312f, 0.37496f, 1.44248f}, {3.98316f, 2.38572f, 1.60322f}},
    {"Be", true, {4.18506f, 3.18506f, 2.78409f}, {3.83544f, 3.01013f, 2.86901f}},
    {"Cr", false, {4.36968f, 2.91670f, 1.65470f}, {5.20643f, 4.23136f, 3.75495f}},
    {"CsI", true, {2.14490f, 1.70232f, 1.66242f}, {0, 0, 0}},
    {"Cu", false, {0.20044f, 0.92403f, 1.10221f}, {3.91295f, 2.45285f, 2.14219f}},
    {"Cu_palik", false, {0.21268f, 0.91999f, 1.10241f}, {3.92156f, 2.45715f, 2.13665f}},
    {"Cu2O", true, {3.54928f, 2.95206f, 2.73692f}, {0.11322f, 0.19467f, 0.60017f}},
    {"CuO", true, {3.24538f, 2.44963f, 2.19741f}, {0.52027f, 0.57074f, 0.71723f}},
    {"d-C", true, {2.71125f, 2.31858f, 2.22886f}, {0, 0, 0}},
    {"Hg", true, {2.39893f, 1.44003f, 0.90955f}, {6.32763f, 4.37194f, 3.42179f}},
    {"HgTe", true, {4.77953f, 3.23100f, 2.66003f}, {1.63198f, 1.58082f, 1.72958f}},
    {"Ir", true, {3.08641f, 2.08219f, 1.61789f}, {5.59215f, 4.06718f, 3.26726f}},
    {"K", true, {0.06405f, 0.04641f, 0.03818f}, {2.10422f, 1.34894f, 0.91321f}},
    {"Li", true, {0.26579f, 0.19561f, 0.22092f}, {3.54017f, 2.31113f, 1.66859f}},
    {"MgO", true, {2.08959f, 1.65072f, 1.59488f}, {0, 0, 0}},
    {"Mo", true, {4.48370f, 3.52546f, 2.77608f}, {4.11113f, 3.42087f, 3.15060f}},
    {"Na_palik", false, {0.06027f, 0.05614f, 0.06199f}, {3.17929f, 2.11248f, 1.57909f}},
    {"Nb", true, {3.42014f, 2.79019f, 2.39559f}, {3.44138f, 2.73764f, 2.57991f}},
    {"Ni_palik", false, {2.36728f, 1.66336f, 1.46706f}, {4.49883f, 3.05016f, 2.34543f}},
    {"Rh", true, {2.58580f, 1.86019f, 1.55443f}, {6.78229f, 4.70295f, 3.97609f}},
    {"Se", true, {4.05926f, 2.84269f, 2.82076f}, {0.75438f, 0.63852f, 0.52159f}},
    {"Se-e", true, {5.72427f, 4.16540f, 4.08161f}, {0.87137f, 1.10528f, 1.56478f}},
    {"SiC", true, {3.17235f, 2.52597f, 2.47936f}, {0, 0, 0.00001f}},
    {"SnTe", true, {4.52519f, 1.98115f, 1.28168f}, {0, 0, 0}},
    {"Ta", true, {2.06258f, 2.39309f, 2.62807f}, {2.40805f, 1.74137f, 1.94704f}},
    {"Te", true, {7.39084f, 4.48210f, 2.63707f}, {3.25614f, 3.52739f, 3.29217f}},
    {"Te-e", true, {7.50904f, 4.29646f, 2.36987f}, {5.58421f, 4.94762f, 3.99751f}},
    {"ThF4", true, {1.83072f, 1.44223f, 1.38765f}, {0, 0, 0}},
    {"TiC", true, {3.70047f, 2.83744f, 2.58230f}, {3.26569f, 2.35156f, 2.17279f}},
    {"TiN", true, {1.64847f, 1.15045f, 1.37978f}, {3.36846f, 1.94349f, 1.10201f}},
    {"TiO2", true, {3.45662f, 2.80171f, 2.90515f}, {0.00010f, 0, 0.00064f}},
    {"TiO2-e", true, {3.10656f, 2.51316f, 2.58238f}, {0.00003f, 0, 0.00018f}},
    {"V_palik", false, {4.27751f, 3.51315f, 2.76113f}, {3.49118f, 2.88936f, 3.11170f}},
    {"VC", true, {3.65757f, 2.75273f, 2.53268f}, {3.06835f, 2.19869f, 1.96318f}},
    {"VN", true, {2.86560f, 2.11918f, 1.94008f}, {3.03233f, 2.05611f, 1.61629f}},
    {"W", false, {4.37070f, 3.30030f, 2.99827f}, {3.50068f, 2.60487f, 2.27319f}},
};

constexpr std::string_view kPalik = "_palik";

bool is_named(const Conductor& c, std::string_view name) {
  if (name == c.name) return true;
  return c.palik && name.size() == c.name.size() + kPalik.size() && name.starts_with(c.name) &&
         name.ends_with(kPalik);
}

}  // namespace

std::optional<float> named_ior(const std::string& name) {
  std::string lower = name;
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const Dielectric& d : kDielectrics) {
    if (d.name == lower) return d.eta;
  }
  return std::nullopt;
}

std::vector<std::string> ior_names() {
  std::vector<std::string> names;
  for (const Dielectric& d : kDielectrics) names.emplace_back(d.name);
  return names;
}

std::optional<ConductorIor> named_conductor(const std::string& name) {
  for (const Conductor& c : kConductors) {
    if (is_named(c, name)) return ConductorIor{c.eta, c.k};
  }
  return std::nullopt;
}

std::vector<std::string> conductor_names() {
  std::vector<std::string> names;
  for (const Conductor& c : kConductors) {
    names.emplace_back(c.name);
    if (c.palik) names.push_back(std::string(c.name) + std::string(kPalik));
  }
  return names;
}

}  // namespace octolux
