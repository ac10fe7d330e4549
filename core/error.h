// Bad input. Thrown only while loading and checking arguments, caught only in tools/main.cpp, where
// it becomes one line on stderr and exit code 2.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace octolux {

/// `what()` is the whole line: "file:line: what is wrong, what was expected".
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The candidate closest to `name` by edit distance, if it is close enough to be a typing slip;
/// otherwise "".
std::string closest_name(const std::string& name, const std::vector<std::string>& candidates);

/// "unknown KIND 'NAME'; legal: a, b, c" with "(did you mean 'b'?)" for a typing slip.
std::string unknown_name(const std::string& kind, const std::string& name,
                         std::vector<std::string> legal);

}  // namespace octolux
