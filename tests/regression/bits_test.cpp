// An unmeant change of any bit is seen: tiny renders against stored hashes. Other compilers and
// processors have other bits: without hashes of theirs there is nothing to compare, and it skips.
#include "tests/regression/bits.h"

#include <gtest/gtest.h>

namespace octolux::test {
namespace {

TEST(RegressionBits, AreThoseStored) {
  const StoredHashes all = read_hashes(read_file(kHashFile));
  const auto now = render_hashes();
  const auto stored = all.find(platform());
  if (stored == all.end()) {
    GTEST_SKIP() << "no hashes are stored for this compiler and instruction set; they are\n"
                 << hash_lines(platform(), now);
  }
  std::string changed;
  for (const auto& [render_name, hash] : now) {
    const auto before = stored->second.find(render_name);
    const bool same = before != stored->second.end() && before->second == hash;
    if (!same) changed += " " + render_name;
  }
  EXPECT_EQ(changed, "")
      << "These renders have other bits than before. That is information, not a failure of "
         "accuracy, about which the other regression tests decide. If the change is meant, run "
         "tools/update-references --hashes and commit what it writes.";
}

TEST(RegressionBits, OneBitIsSeen) {
  const auto scene = shipped_scene("cornell/cornell.xml");
  resize_film(*scene, 4, 4);
  const Film film = render_film(*scene, path_config(1));
  Film other(4, 4);
  PassImage pass(16);
  const Image image = film.radiance();
  for (std::size_t i = 0; i < pass.size(); ++i) pass[i].direct = image.pixels[i];
  other.add(pass);
  EXPECT_EQ(hash_of(other), hash_of(film));
  Film changed(4, 4);
  pass[7].direct.g = std::nextafter(pass[7].direct.g, 100.0f);
  changed.add(pass);
  EXPECT_NE(hash_of(changed), hash_of(film));
}

TEST(RegressionBits, HashesAreReadAsTheyAreWritten) {
  const std::map<std::string, std::string> hashes = {{"cone", "12"}, {"path", "ab"}};
  const StoredHashes stored = read_hashes("# a comment\n" + hash_lines("here", hashes));
  EXPECT_EQ(stored, (StoredHashes{{"here", hashes}}));
}

}  // namespace
}  // namespace octolux::test
