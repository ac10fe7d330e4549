// A page that tests itself (tools/compare/page.h), opened in headless Chromium, and what is written
// in it.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/tools/program.h"

namespace octolux::test {

inline std::string between(const std::string& text, const std::string& begin,
                           const std::string& end) {
  const auto from = text.find(begin);
  if (from == std::string::npos) return "";
  const auto start = from + begin.size();
  return text.substr(start, text.find(end, start) - start);
}

/// The JSON text that a page carries.
inline std::string data_of(const std::string& html) {
  return between(html, "<script type=\"application/json\" id=\"data\">", "</script>");
}

inline bool has_browser() { return std::system("command -v chromium >/dev/null 2>&1") == 0; }
inline constexpr char kNoBrowser[] =
    "no chromium here; apt-get install chromium, and the page is tested in it";

/// What the self-test of `page`, a file of the folder, says as JSON; its console must stay silent.
inline nlohmann::json self_test(const TemporaryFolder& folder, const std::string& page) {
  const std::string command =
      "cd '" + folder.path() +
      "' && HOME=$PWD timeout 120 chromium --headless --no-sandbox --disable-gpu "
      "--disable-dev-shm-usage --user-data-dir=profile --enable-logging=stderr "
      "--virtual-time-budget=30000 --dump-dom \"file://$PWD/" +
      page + "?selftest\" >dom 2>log";
  EXPECT_EQ(std::system(command.c_str()), 0) << read_file(folder / "log");
  const std::string log = read_file(folder / "log");
  EXPECT_EQ(log.find("CONSOLE"), std::string::npos) << log;
  const std::string result = between(read_file(folder / "dom"), "<pre id=\"selftest\">", "</pre>");
  EXPECT_NE(result, "") << log;
  return result.empty() ? nlohmann::json{{"passed", false}} : nlohmann::json::parse(result);
}

}  // namespace octolux::test
