// Refractive indices by name.
#include <gtest/gtest.h>

#include <set>

#include "core/fresnel.h"
#include "core/ior.h"

namespace octolux {
namespace {

TEST(NamedIor, FindsWhatMitsubaKnows) {
  EXPECT_EQ(named_ior("bk7"), 1.5046f);
  EXPECT_EQ(named_ior("BK7"), 1.5046f);
  EXPECT_EQ(named_ior("air"), 1.000277f);
  EXPECT_EQ(named_ior("carbon tetrachloride"), 1.461f);
  EXPECT_EQ(named_ior("Au"), std::nullopt);
  EXPECT_EQ(named_ior(""), std::nullopt);
}

TEST(NamedIor, ListsEveryNameOnce) {
  const std::vector<std::string> names = ior_names();
  EXPECT_EQ(names.size(), 23u);
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
  for (const std::string& name : names) EXPECT_GE(named_ior(name).value(), 1) << name;
}

TEST(NamedConductor, FindsMetals) {
  const ConductorIor gold = named_conductor("Au").value();
  const Rgb f = fresnel_conductor(1, gold.eta, gold.k);
  EXPECT_GT(f.r, f.g);
  EXPECT_GT(f.g, f.b);
  EXPECT_GT(f.r, 0.9f);
  const Rgb silver =
      fresnel_conductor(1, named_conductor("Ag").value().eta, named_conductor("Ag").value().k);
  EXPECT_GT(silver.b, 0.85f);
  EXPECT_EQ(named_conductor("gold"), std::nullopt);
  EXPECT_EQ(named_conductor("W_palik"), std::nullopt);
}

TEST(NamedConductor, NoneIsAPerfectMirror) {
  const ConductorIor none = named_conductor("none").value();
  EXPECT_EQ(fresnel_conductor(0.3f, none.eta, none.k), Rgb(1));
}

TEST(NamedConductor, EveryNameGivesAPhysicalIndex) {
  const std::vector<std::string> names = conductor_names();
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
  for (const std::string& name : names) {
    const ConductorIor ior = named_conductor(name).value();
    for (int c = 0; c < 3; ++c) {
      EXPECT_GE(ior.eta[c], 0) << name;
      EXPECT_GE(ior.k[c], 0) << name;
    }
  }
  EXPECT_EQ(named_conductor("TiN")->eta, named_conductor("TiN_palik")->eta);
}

}  // namespace
}  // namespace octolux
