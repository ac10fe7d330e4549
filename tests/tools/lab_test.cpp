// The laboratory: what it draws is what its cases say, what it reads and writes can be used.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/file_io.h"
#include "tests/stats.h"
#include "tests/tools/program.h"
#include "tools/lab/csv_photons.h"
#include "tools/lab/reach.h"
#include "tools/lab/report.h"

namespace octolux {
namespace {

/// The flux that lands within a small disc around the query is its area: the irradiance is 1.
TEST(Lab, EveryCaseHasUnitIrradianceAtTheQuery) {
  constexpr int kRuns = 300;
  constexpr double kRadius = 0.1;
  for (const LabCase& c : lab_cases()) {
    const double distance = std::max(c.distance, 0.3);
    const double size = std::string(c.name) == "strip" ? 1 : c.size;
    const LabWorld world(c.layout(distance, size), 25);
    test::Running flux;
    for (int run = 0; run < kRuns; ++run) {
      Rng rng(1, Stream::test, 0, static_cast<std::uint64_t>(run));
      double within = 0;
      for (const Photon& p : world.photons(500, PhotonPattern::poisson, rng)) {
        if (p.normal.z > 0.9f && length(p.position) < kRadius) within += p.flux.g;
      }
      flux.add(within / (std::numbers::pi * kRadius * kRadius));
    }
    EXPECT_GT(test::z_test_p(flux.z(1)), test::sidak(test::kAlpha, lab_cases().size())) << c.name;
  }
}

TEST(Lab, LowDiscrepancyPhotonsAreMoreEven) {
  LabSettings settings;
  settings.kernels = {parse_lab_kernel("disc")};
  settings.neighbours = {50};
  settings.runs = 500;
  const LabLayout plane = find_lab_case("plane").layout(0, 0);
  const double poisson = measure(plane, settings)[0].deviation;
  settings.pattern = PhotonPattern::low_discrepancy;
  EXPECT_LT(measure(plane, settings)[0].deviation, poisson / 2);
}

/// Where the surface ends all round there are photons enough for what is left of the disc, so a
/// kernel that probes for edges is right on a round rim.
TEST(Lab, HasPhotonsEnoughOnARim) {
  LabSettings settings;
  settings.kernels = {parse_lab_kernel("region")};
  settings.neighbours = {50};
  settings.runs = 800;
  const LabResult rim = measure(find_lab_case("disc-edge").layout(0, 2), settings)[0];
  EXPECT_GT(test::z_test_p(rim.bias() / rim.standard_error), test::kAlpha);
}

TEST(Lab, FiguresDoNotDependOnWhenTheyAreTaken) {
  LabSettings settings;
  settings.kernels = {parse_lab_kernel("octobox"), parse_lab_kernel("cone:published")};
  settings.neighbours = {20};
  settings.runs = 200;
  const LabLayout wall = find_lab_case("wall").layout(0.2, 0);
  const std::vector<LabResult> once = measure(wall, settings), twice = measure(wall, settings);
  for (std::size_t i = 0; i < once.size(); ++i) EXPECT_EQ(once[i].mean, twice[i].mean);
}

TEST(Lab, KernelsAreNamedWithTheirOptions) {
  const LabKernel kernel = parse_lab_kernel("octobox:eight:published");
  EXPECT_EQ(kernel.config.kernel, "octobox");
  EXPECT_EQ(kernel.config.octants, "eight");
  EXPECT_FALSE(kernel.config.correction);
  EXPECT_THROW(parse_lab_kernel("octobox:nine"), Error);
  EXPECT_THROW(parse_lab_kernel("box"), Error);
  EXPECT_THROW(find_lab_case("wal"), Error);
}

class LabFiles : public ::testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) {
    write_file(folder_ / name, {text.data(), text.size()});
    return folder_ / name;
  }
  static std::string message(const std::function<void()>& read) {
    try {
      read();
    } catch (const Error& e) {
      return e.what();
    }
    return "";
  }
  test::TemporaryFolder folder_;
};

constexpr char kHeader[] = "x,y,z,nx,ny,nz,wx,wy,wz,r,g,b\n";

TEST_F(LabFiles, PhotonsAreRead) {
  const std::string file =
      write("p.csv", "# mine\n" + std::string(kHeader) + "1,2,3, 0,0,2, 0,1,1, 0.5,1e-3,7\r\n\n");
  const std::vector<Photon> photons = read_photon_csv(file);
  ASSERT_EQ(photons.size(), 1u);
  EXPECT_EQ(photons[0].position, (Vec3{1, 2, 3}));
  EXPECT_EQ(photons[0].normal, (Vec3{0, 0, 1}));
  EXPECT_EQ(photons[0].flux.g, 1e-3f);
  EXPECT_EQ(read_query_csv(write("q.csv", "nx,ny,nz,x,y,z\n0,1,0,4,5,6\n"))[0].position,
            (Vec3{4, 5, 6}));
}

TEST_F(LabFiles, WhatCannotBeReadIsNamedWithItsLine) {
  const auto complaint = [&](const std::string& text) {
    const std::string file = write("bad.csv", text);
    return message([&] { read_photon_csv(file); });
  };
  EXPECT_NE(complaint(kHeader + std::string("1,2,3,0,0,1,0,0,1,1,1,one\n")).find(":2: expected"),
            std::string::npos);
  EXPECT_NE(complaint(kHeader + std::string("1,2\n")).find("12 columns"), std::string::npos);
  EXPECT_NE(complaint("x,y,zz\n").find("unknown column 'zz'"), std::string::npos);
  EXPECT_NE(complaint("x,y,z\n").find("column 'nx' must be there"), std::string::npos);
  EXPECT_NE(complaint(kHeader + std::string("1,2,3,0,0,0,0,0,1,1,1,1\n")).find("no direction"),
            std::string::npos);
  EXPECT_NE(complaint("").find("no header"), std::string::npos);
  EXPECT_NE(message([] { read_photon_csv("/nowhere.csv"); }).find("cannot be read"),
            std::string::npos);
}

TEST_F(LabFiles, TheVerbWritesTablesAndPlots) {
  const test::Outcome outcome =
      test::Program(folder_, {"lab", "--case", "wall", "--kernel", "disc", "octobox:one",
                              "--neighbours", "10", "50", "--runs", "50", "--csv", "a.csv",
                              "--json", "a.json", "--plot", "a.svg"})
          .wait();
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const nlohmann::json rows = nlohmann::json::parse(test::read_file(folder_ / "a.json"));
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_NEAR(rows[0]["mean"].get<double>(), 0.5, 0.2);
  EXPECT_EQ(rows[1]["kernel"], "octobox:one");
  const std::string csv = test::read_file(folder_ / "a.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 5);
  const std::string svg = test::read_file(folder_ / "a.svg");
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
  EXPECT_NE(svg.find("octobox:one"), std::string::npos);
}

TEST_F(LabFiles, TheVerbReadsPeoplesOwnPhotons) {
  std::string photons = kHeader;
  for (int i = 0; i < 400; ++i) {
    photons += std::to_string(i % 20) + "," + std::to_string(i / 20) + ",0,0,0,1,0,0,1,1,2,3\n";
  }
  write("p.csv", photons);
  write("q.csv", "x,y,z,nx,ny,nz\n9.5,9.5,0,0,0,1\n");
  const test::Outcome outcome =
      test::Program(folder_, {"lab", "--photons", "p.csv", "--queries", "q.csv", "--kernel", "disc",
                              "--neighbours", "50"})
          .wait();
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("query,kernel,neighbours,r,g,b,h,area,count"), std::string::npos);
  EXPECT_NE(outcome.out.find("0,disc,50,"), std::string::npos) << outcome.out;
  EXPECT_EQ(test::Program(folder_, {"lab", "--photons", "p.csv"}).wait().exit_code, 2);
  EXPECT_EQ(test::Program(folder_, {"lab", "--case", "wal"}).wait().exit_code, 2);
}

}  // namespace
}  // namespace octolux
