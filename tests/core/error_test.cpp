// Suggestions for misspelt names.
#include "core/error.h"

#include <gtest/gtest.h>

namespace octolux {
namespace {

const std::vector<std::string> kNames{"diffuse", "dielectric", "conductor", "roughconductor"};

TEST(ClosestName, FindsTypingSlips) {
  EXPECT_EQ(closest_name("difuse", kNames), "diffuse");       // missing letter
  EXPECT_EQ(closest_name("diffusse", kNames), "diffuse");     // one too many
  EXPECT_EQ(closest_name("condvctor", kNames), "conductor");  // wrong letter
  EXPECT_EQ(closest_name("diffsue", kNames), "diffuse");      // two swapped
  EXPECT_EQ(closest_name("Diffuse", kNames), "diffuse");      // case
}

TEST(ClosestName, SaysNothingWhenNothingIsClose) {
  EXPECT_EQ(closest_name("principled", kNames), "");
  EXPECT_EQ(closest_name("", kNames), "");
  EXPECT_EQ(closest_name("x", {"k"}), "");
  EXPECT_EQ(closest_name("diffuse", {}), "");
}

TEST(ClosestName, PrefersTheSmallerDistance) {
  EXPECT_EQ(closest_name("alpha_w", {"alpha_xyz", "alpha_u", "beta"}), "alpha_u");
}

TEST(UnknownName, ListsLegalNamesSortedAndOnce) {
  EXPECT_EQ(unknown_name("shape", "qube", {"sphere", "cube", "sphere"}),
            "unknown shape 'qube'; legal: cube, sphere (did you mean 'cube'?)");
  EXPECT_EQ(unknown_name("shape", "heightfield", {"cube"}),
            "unknown shape 'heightfield'; legal: cube");
  EXPECT_EQ(unknown_name("id", "a", {}), "unknown id 'a'; legal: none");
}

}  // namespace
}  // namespace octolux
