// Every kernel against reference EXRs: with final gather, and the photon map itself; and the path
// tracer. The gate (gate.h) has no tolerance of its own: noise is measured, bias is stated.
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/regression/allowance.h"
#include "tests/regression/evidence.h"

namespace octolux::test {
namespace {

struct Trial {
  std::string scene, kernel;
  bool gather;

  std::string name() const {
    std::string text = scene + "_" + kernel + (gather ? "" : "_shown");
    std::replace(text.begin(), text.end(), '-', '_');
    return text;
  }
};

/// For messages of the test framework, which finds it by this name.
void PrintTo(const Trial& trial, std::ostream* out) { *out << trial.name(); }

std::vector<Trial> trials() {
  std::vector<Trial> all;
  for (const RegressionCase& c : regression_cases()) {
    all.push_back({c.name, "path", true});
    for (const std::string& kernel : c.gathered) all.push_back({c.name, kernel, true});
    for (const std::string& kernel : c.shown) all.push_back({c.name, kernel, false});
  }
  return all;
}

class RegressionSlow : public testing::TestWithParam<Trial> {};

TEST_P(RegressionSlow, IsWithinNoiseAndStatedBias) {
  const RegressionCase& c = regression_case(GetParam().scene);
  const ExrFile reference = read_exr(reference_path(c));
  const auto scene = load_case(c);
  const RenderConfig config = regression_config(c, GetParam().kernel, GetParam().gather);
  const Batches batches = render_batches(*scene, config);
  const GateResult result = check_gate(batches, allowed_for(*scene, config, reference, batches));
  std::printf("  %s: %d tests, smallest p %.2g (%s)\n", GetParam().name().c_str(), result.tests,
              result.worst_p, result.worst.c_str());
  EXPECT_TRUE(result.passed()) << result.failed << " of " << result.tests
                               << " failed; worst: " << result.worst << "\nsee "
                               << leave_evidence(GetParam().name(), reference, batches)
                               << "/index.html";
}

INSTANTIATE_TEST_SUITE_P(All, RegressionSlow, testing::ValuesIn(trials()),
                         [](const testing::TestParamInfo<Trial>& param) {
                           return param.param.name();
                         });

}  // namespace
}  // namespace octolux::test
