// MTL: what the file gives is told from what it leaves out, and each kind of material follows from
// the rules in mtl_material.h.
#include "renderer/mtl_material.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/constants.h"
#include "core/error.h"
#include "core/image_io.h"
#include "tests/renderer/temp_files.h"

namespace octolux {
namespace {

MtlFile read(const std::string& text) {
  const test::TempFolder folder;
  return read_mtl_file(folder.write("a.mtl", text));
}

MtlMaterial material(const std::string& lines) {
  return read("newmtl m\n" + lines).materials.at(0);
}

std::string error_of(const std::string& text) {
  const std::string message = test::message_of<Error>([&] { read(text); });
  const std::size_t at = message.find("a.mtl:");
  return at == std::string::npos ? message : message.substr(at + 6);
}

TEST(MtlFile, ValuesAndDefaults) {
  const MtlMaterial m = material(
      "Kd 0.1 .2 3e-1 # red\n\tKs 0.5\r\nKe 17 12 4\nTf 0.9 0.8 0.7\nNs 200\nNi 1.6\nd 0.25\n"
      "illum 2\nmap_Kd a b.png\nbump -bm 2 c.png\n");
  EXPECT_EQ(m.kd, Rgb(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(m.ks, Rgb(0.5f));  // a single number stands for all three
  EXPECT_EQ(m.ke, Rgb(17, 12, 4));
  EXPECT_EQ(m.tf, Rgb(0.9f, 0.8f, 0.7f));
  EXPECT_EQ(m.ns, 200);
  EXPECT_EQ(m.ni, 1.6f);
  EXPECT_EQ(m.opacity, 0.25f);
  EXPECT_EQ(m.illum, 2);
  ASSERT_EQ(m.maps.size(), 2u);
  EXPECT_EQ(m.maps[0].key, "map_Kd");
  EXPECT_EQ(m.maps[0].file, "a b.png");
  EXPECT_EQ(m.maps[1].key, "bump");
  EXPECT_EQ(m.maps[1].file, "c.png");
  const MtlMaterial none = material("");
  EXPECT_EQ(none.kd, Rgb(0));
  EXPECT_EQ(none.ni, 1);
  EXPECT_EQ(none.opacity, 1);
  EXPECT_EQ(none.illum, -1);
  EXPECT_EQ(material("illum 0\n").illum, 0);
  EXPECT_EQ(material("Tr 0.75\n").opacity, 0.25f);
  EXPECT_EQ(material("Tr 0.75\nd 1\n").opacity, 1);  // d wins in either order
  EXPECT_EQ(material("d 1\nTr 0.75\n").opacity, 1);
}

TEST(MtlFile, NamesAreTrimmedAndTheFirstOfANameCounts) {
  const MtlFile file = read("newmtl  a b \r\nKd 1 0 0\nnewmtl c\nKd 0 1 0\nnewmtl a b\nKd 0 0 1\n");
  ASSERT_EQ(file.materials.size(), 2u);
  EXPECT_EQ(file.materials[0].name, "a b");
  EXPECT_EQ(file.materials[0].kd, Rgb(1, 0, 0));
  EXPECT_EQ(file.materials[1].name, "c");
}

TEST(MtlFile, UnknownKeysAreSaidOnce) {
  const MtlFile file = read("newmtl a\nPe 10\nKd 1 1 1\nnewmtl b\nPe 10 10 10\nfoo\n");
  ASSERT_EQ(file.warnings.size(), 2u);
  EXPECT_NE(file.warnings[0].find("a.mtl:2: unknown key 'Pe'"), std::string::npos);
  EXPECT_NE(file.warnings[1].find("a.mtl:6: unknown key 'foo'"), std::string::npos);
}

TEST(MtlFile, BadValuesNameTheirLine) {
  EXPECT_EQ(error_of("newmtl a\nKd spectral wood.rfl\n"), "2: Kd needs one or three numbers");
  EXPECT_EQ(error_of("newmtl a\nKd 1 2\n"), "2: Kd needs one or three numbers");
  EXPECT_EQ(error_of("newmtl a\nKe nan nan nan\n"), "2: Ke needs one or three numbers");
  EXPECT_EQ(error_of("newmtl a\nKd 1 -0.5 1\n"), "2: Kd must not be negative");
  EXPECT_EQ(error_of("newmtl a\n\nNs shiny\n"), "3: Ns needs a number");
  EXPECT_EQ(error_of("newmtl a\nNi\n"), "2: Ni needs a number");
  EXPECT_EQ(error_of("newmtl \n"), "1: newmtl needs a name");
}

TEST(MtlMaterial, Kinds) {
  const auto kind_of = [](const std::string& lines) { return kind(material(lines)); };
  EXPECT_EQ(kind_of("Kd 1 1 1\n"), MtlKind::diffuse);
  EXPECT_EQ(kind_of("Kd 1 1 1\nNi 1.5\nillum 2\nTf 1 1 1\nd 1\nTr 0\n"), MtlKind::diffuse);
  EXPECT_EQ(kind_of("Kd 1 1 1\nKs .3 .3 .3\nillum 1\n"), MtlKind::diffuse);
  EXPECT_EQ(kind_of("Kd .5 .5 .5\nKs .7 .7 .7\nNs 32\nTf .3 .3 .3\n"), MtlKind::glossy);
  EXPECT_EQ(kind_of("Kd .5 .5 .5\nKs .7 .7 .7\nNs 1000\n"), MtlKind::glossy);
  EXPECT_EQ(kind_of("Ks 1 1 1\nNs 1000\n"), MtlKind::mirror);
  EXPECT_EQ(kind_of("Ks 1 1 1\nNs 999\n"), MtlKind::glossy);
  EXPECT_EQ(kind_of("Kd .01 .01 .01\nKs .95 .95 .95\nillum 5\nNi 3.3\nNs 1000\n"), MtlKind::mirror);
  EXPECT_EQ(kind_of("Kd .9 .9 .9\nKs .1 .1 .1\nillum 3\n"), MtlKind::glossy);
  EXPECT_EQ(kind_of("Kd .9 .9 .9\nillum 3\n"), MtlKind::diffuse);
  EXPECT_EQ(kind_of("Ks .04 .04 .04\nNs 200\nNi 1.6\nTf .95 .95 .95\n"), MtlKind::glass);
  EXPECT_EQ(kind_of("Kd .01 .01 .01\nKs .3 .3 .3\nTf .1 .1 .1\nNs 200\nNi 1.33\nillum 7\n"),
            MtlKind::glass);
  EXPECT_EQ(kind_of("Kd 1 1 1\nNi 1.5\nillum 2\nd 0.3\n"), MtlKind::glass);
  EXPECT_EQ(kind_of("Kd 1 1 1\nNi 1\nillum 4\nTf 1 1 1\n"), MtlKind::diffuse);  // Maya's default
  EXPECT_EQ(kind_of("Kd 1 1 1\nd 0.3\n"), MtlKind::diffuse);                    // masked
}

/// The BSDF of a material, and what was said about it.
struct Made {
  Scene scene;
  const Bsdf* bsdf = nullptr;
};
std::unique_ptr<Made> make(const std::string& lines) {
  auto made = std::make_unique<Made>();
  made->bsdf =
      made->scene.bsdfs.at(static_cast<std::size_t>(add_bsdf(material(lines), made->scene))).get();
  return made;
}

TEST(MtlMaterial, ColoursAreLinearAndSurfacesTwoSided) {
  const auto made = make("Kd 0.63 0.065 0.05\n");
  const SurfacePoint at;
  for (const float side : {1.0f, -1.0f}) {
    const auto rho = made->bsdf->lambertian(at, {0, 0, side});
    ASSERT_TRUE(rho.has_value());
    EXPECT_EQ(*rho, Rgb(0.63f, 0.065f, 0.05f));
  }
  EXPECT_TRUE(made->scene.warnings.empty());
}

TEST(MtlMaterial, MirrorReflectsKsFromBothSides) {
  const auto made = make("Ks 0.95 0.9 0.85\nNs 1000\n");
  EXPECT_EQ(made->bsdf->lobes(), Lobes::delta);
  for (const float side : {1.0f, -1.0f}) {
    const auto s =
        made->bsdf->sample({}, {0, 0, side}, 0.5f, {0.5f, 0.5f}, Lobes::all, Carried::radiance);
    ASSERT_TRUE(s.has_value());
    EXPECT_GT(s->wi.z * side, 0);
    EXPECT_NEAR(s->weight.r, 0.95f, 1e-6f);
    EXPECT_NEAR(s->weight.b, 0.85f, 1e-6f);
  }
}

TEST(MtlMaterial, GlassFiltersByTfOnTheWayThrough) {
  // In at one surface, out at the other: at right angles ((1 - R) sqrt(Tf))^2 of the flux.
  const auto made = make("Ni 1.5\nTf 0.49 0.81 1\nillum 7\n");
  Rgb through(1);
  for (const float side : {1.0f, -1.0f}) {
    const auto s = made->bsdf->sample({}, {0, 0, side}, kOneMinusEpsilon, {0.5f, 0.5f}, Lobes::all,
                                      Carried::flux);
    ASSERT_TRUE(s.has_value());
    ASSERT_LT(s->wi.z * side, 0) << "the last lobe is refraction";
    through = through * (s->weight * s->pdf_w);
  }
  const float t = 0.96f * 0.96f;
  const float tolerance = 16 * 0x1p-23f;
  EXPECT_NEAR(through.r, 0.49f * t, tolerance);
  EXPECT_NEAR(through.g, 0.81f * t, tolerance);
  EXPECT_NEAR(through.b, t, tolerance);
}

TEST(MtlMaterial, OpacityLetsLightPassStraight) {
  const auto made = make("Kd 0.5 0.5 0.5\nd 0.25\n");
  EXPECT_TRUE(made->bsdf->passes_light());
  EXPECT_EQ(made->bsdf->pass_through({}, {0, 0, 1}), Rgb(0.75f));
  EXPECT_FALSE(make("Kd 0.5 0.5 0.5\nd 0.999\n")->bsdf->passes_light());  // 8-bit opaque
}

TEST(MtlMaterial, SpecularMapScalesKs) {
  const test::TempFolder folder;
  Image image(2, 1);
  image.pixels = {Rgb(0), Rgb(1)};
  write_png(folder.path("ks.png"), image);
  const MtlFile file = read_mtl_file(folder.write(
      "a.mtl",
      "newmtl a\nKd .2 .2 .2\nKs .5 .5 .5\nmap_Ks ks.png\nnewmtl b\nKd .5 .5 .5\nmap_Ks ks.png\n"));
  for (const MtlMaterial& m : file.materials) {
    EXPECT_EQ(kind(m), MtlKind::glossy);
    Scene scene;
    const Bsdf& bsdf = *scene.bsdfs[static_cast<std::size_t>(add_bsdf(m, scene))];
    EXPECT_TRUE(scene.warnings.empty());
    // Straight down and back f is Ks D / 4, and the base under the coat.
    const auto reflected = [&](float u) {
      SurfacePoint at;
      at.uv = Vec2{u, 0.5f};
      return bsdf.f(at, {0, 0, 1}, {0, 0, 1}, Lobes::near_specular | Lobes::smooth,
                    Carried::radiance);
    };
    const float base = m.name == "a" ? 0.2f * kInvPi : 0.5f * kInvPi;
    EXPECT_NEAR(reflected(0.25f).g, base, 1e-5f);  // black: no coat
    const auto all = make(m.name == "a" ? "Kd .2 .2 .2\nKs .5 .5 .5\n" : "Kd .5 .5 .5\nKs 1 1 1\n");
    EXPECT_NEAR(reflected(0.75f).g,
                all->bsdf->f({}, {0, 0, 1}, {0, 0, 1}, Lobes::all, Carried::radiance).g, 1e-5f);
  }
}

TEST(MtlMaterial, Warnings) {
  const auto said = [](const std::string& lines) {
    const auto made = make(lines);
    return made->scene.warnings.empty() ? "" : made->scene.warnings.at(0);
  };
  EXPECT_NE(said("Kd 1.5 0 0\n").find("a.mtl:1: material 'm': Kd above 1"), std::string::npos);
  EXPECT_NE(said("map_Kd x.png\n").find("texture file not found: map_Kd x.png"), std::string::npos);
  EXPECT_NE(said("Ka 1 1 1\n").find("gives no colour; taken as grey"), std::string::npos);
  EXPECT_EQ(said("Kd 0 0 0\n"), "");
  EXPECT_EQ(said("Ke 1 1 1\n"), "");
}

}  // namespace
}  // namespace octolux
