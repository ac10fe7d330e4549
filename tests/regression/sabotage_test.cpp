// The gate's power: renders that are wrong by little, in ways that bugs are, must fail it. Each is
// wrong by its scene or its settings, not by its code, and is held to what the right one is held
// to.
#include <gtest/gtest.h>

#include <cstdio>
#include <regex>

#include "core/file_io.h"
#include "tests/regression/allowance.h"

namespace octolux::test {
namespace {

/// The case's scene with every reflectance times `factor`.
std::unique_ptr<Scene> with_albedo_times(const RegressionCase& c, double factor) {
  const std::string xml = read_file(std::string(OCTOLUX_SOURCE_DIR "/scenes/") + c.scene);
  const std::regex reflectance("name=\"reflectance\" value=\"([0-9.]+), ([0-9.]+), ([0-9.]+)\"");
  std::string changed;
  auto rest = xml.cbegin();
  for (std::sregex_iterator it(xml.begin(), xml.end(), reflectance), end; it != end; ++it) {
    changed.append(rest, (*it)[0].first);
    changed += "name=\"reflectance\" value=\"";
    for (int i = 1; i <= 3; ++i) {
      changed += (i > 1 ? ", " : "") + std::to_string(factor * std::stod((*it)[i]));
    }
    changed += "\"";
    rest = (*it)[0].second;
  }
  changed.append(rest, xml.cend());
  EXPECT_NE(changed, xml);
  auto scene = scene_from(changed);
  set_film(*scene, c);
  return scene;
}

/// What is rendered, and as what it claims to pass.
struct Sabotage {
  std::string scene;
  std::string claimed, rendered;  // kernels, or "path"
  bool gather = true;
  double albedo = 1;
  int max_depth = -1;
};

GateResult judge(const Sabotage& sabotage) {
  const RegressionCase& c = regression_case(sabotage.scene);
  const ExrFile reference = read_exr(reference_path(c));
  const auto right = load_case(c);
  const auto wrong = sabotage.albedo == 1 ? load_case(c) : with_albedo_times(c, sabotage.albedo);
  wrong->max_depth = sabotage.max_depth;
  const RenderConfig claimed = regression_config(c, sabotage.claimed, sabotage.gather);
  const RenderConfig rendered = regression_config(c, sabotage.rendered, sabotage.gather);
  const Batches batches = render_batches(*wrong, rendered);
  const GateResult result = check_gate(batches, allowed_for(*right, claimed, reference, batches));
  std::printf("  %d of %d tests fail, smallest p %.2g (%s)\n", result.failed, result.tests,
              result.worst_p, result.worst.c_str());
  return result;
}

TEST(SabotageSlow, AlbedoTwoPerCentTooBrightPathTraced) {
  EXPECT_FALSE(judge({"cornell", "path", "path", true, 1.02}).passed());
}
TEST(SabotageSlow, AlbedoTwoPerCentTooBrightGathered) {
  EXPECT_FALSE(judge({"cornell", "region", "region", true, 1.02}).passed());
  EXPECT_FALSE(judge({"cornell", "octobox", "octobox", true, 1.02}).passed());
}
TEST(SabotageSlow, AlbedoTwoPerCentTooDarkGathered) {
  EXPECT_FALSE(judge({"cornell", "region", "region", true, 0.98}).passed());
}

/// Everything after the fourth bounce is lost.
TEST(SabotageSlow, DroppedBouncePathTraced) {
  EXPECT_FALSE(judge({"cornell", "path", "path", true, 1, 5}).passed());
}
TEST(SabotageSlow, DroppedBounceGathered) {
  EXPECT_FALSE(judge({"cornell", "octobox", "octobox", true, 1, 5}).passed());
}

/// A feeler kernel without its feelers is the OctoBox: light comes through the wall.
TEST(SabotageSlow, DisabledFeeler) {
  EXPECT_FALSE(judge({"thin-wall", "feeler", "octobox", false}).passed());
}

TEST(SabotageSlow, SwappedKernel) {
  EXPECT_FALSE(judge({"cornell", "octobox", "cone", false}).passed());
  EXPECT_FALSE(judge({"cornell", "region", "cone", false}).passed());
}
/// The published OctoBox in place of the corrected one.
TEST(SabotageSlow, UncorrectedKernel) {
  const RegressionCase& c = regression_case("wall-and-corner");
  RenderConfig config = regression_config(c, "octobox", false);
  const auto scene = load_case(c);
  const ExrFile reference = read_exr(reference_path(c));
  config.estimator.correction = false;
  const Batches batches = render_batches(*scene, config);
  EXPECT_FALSE(check_gate(batches, allowed_for(*scene, config, reference, batches)).passed());
}

}  // namespace
}  // namespace octolux::test
