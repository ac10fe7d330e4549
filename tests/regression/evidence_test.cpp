// A failing regression test leaves everything that is needed to see why.
#include "tests/regression/evidence.h"

#include <gtest/gtest.h>

namespace octolux::test {
namespace {

TEST(RegressionEvidence, IsFourFiles) {
  const RegressionCase& c = regression_case("thin-wall");
  const ExrFile reference = read_exr(reference_path(c));
  const Image truth = reference.image();
  Batches batches{{}, Image(truth.width, truth.height), Image(truth.width, truth.height), 0};
  for (int i = 0; i < kBatches; ++i) {
    batches.radiance.push_back(truth);
    for (Rgb& v : batches.radiance.back().pixels) v *= 1.0f + 0.01f * static_cast<float>(i);
  }
  const std::string folder = leave_evidence("evidence_test", reference, batches);
  const ExrFile image = read_exr(folder + "/image.exr");
  EXPECT_NEAR(image.image().at(5, 5).g, 1.155f * truth.at(5, 5).g, 1e-5f * truth.at(5, 5).g);
  EXPECT_EQ(read_exr(folder + "/reference.exr").image().pixels, truth.pixels);
  EXPECT_GT(read_image(folder + "/difference.png", Encoding::automatic).width, truth.width);
  EXPECT_NE(read_file(folder + "/index.html").find("evidence_test"), std::string::npos);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace octolux::test
