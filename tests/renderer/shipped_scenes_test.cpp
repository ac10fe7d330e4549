// Every scene of this repository: loads without a warning, says what it is for, and is not dark. A
// scene is an .xml file right in a folder of scenes/; parts are deeper.
#include <gtest/gtest.h>

#include "tests/renderer/renders.h"

namespace octolux::test {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> scene_names() {
  const fs::path root = fs::path(OCTOLUX_SOURCE_DIR) / "scenes";
  std::vector<std::string> names;
  for (const auto& folder : fs::directory_iterator(root)) {
    for (const auto& file : fs::directory_iterator(folder)) {
      if (file.path().extension() != ".xml") continue;
      names.push_back(fs::relative(file.path(), root).generic_string());
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

void expect_lit(Scene& scene, const std::string& name) {
  for (const std::string& warning : scene.warnings) ADD_FAILURE() << name << ": " << warning;
  resize_film(scene, 16, 12);
  const Film film = render_film(scene, path_config(4));
  EXPECT_GT(mean_radiance(film).mean, 0) << name;
  EXPECT_EQ(film.non_finite(), 0) << name;
}

class ShippedScenes : public testing::TestWithParam<std::string> {};

TEST_P(ShippedScenes, LoadsAndIsLit) { expect_lit(*shipped_scene(GetParam()), GetParam()); }

TEST_P(ShippedScenes, SaysWhatItIsFor) {
  std::ifstream in(fs::path(OCTOLUX_SOURCE_DIR) / "scenes" / GetParam());
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::string opening = text.substr(0, text.find("<scene"));
  EXPECT_TRUE(opening.find("Shows: ") != opening.npos || opening.find("Expected") != opening.npos);
}

INSTANTIATE_TEST_SUITE_P(All, ShippedScenes, testing::ValuesIn(scene_names()),
                         [](const testing::TestParamInfo<std::string>& param) {
                           std::string name = fs::path(param.param).stem().string();
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST(ShippedScenes, HouseFromEverySide) {
  for (const char* view : {"living", "dining", "bedroom", "study", "hall", "plan"}) {
    expect_lit(*shipped_scene("house/house.xml", {{"view", view}}), view);
  }
}

}  // namespace
}  // namespace octolux::test
