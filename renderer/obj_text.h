// The text of an OBJ file, made ready for tinyobjloader, which knows neither continued lines nor
// comments behind numbers, and drops what it does not know without a word. Line breaks of all three
// kinds become '\n', lines continued with a backslash are joined, comments behind numbers are
// blanked; nothing moves, so an offset still tells the line for messages. Immutable once made.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace octolux {

class ObjText {
 public:
  /// Reads the file. Throws Error if it cannot.
  explicit ObjText(const std::string& path);

  const std::string& path() const { return path_; }
  std::string& text() { return text_; }  // a stream buffer wants it mutable; it is only read
  /// What follows `mtllib` on each such line, blanks trimmed.
  const std::vector<std::string>& mtllibs() const { return mtllibs_; }
  /// Statements that we do not model, and the line where each first occurs.
  const std::map<std::string, std::size_t>& ignored() const { return ignored_; }
  /// Fingerprint of the file's bytes.
  std::uint64_t hash() const { return hash_; }

  /// The line that ends just before `end` (an offset behind its '\n').
  std::string_view line_before(std::size_t end) const;
  /// "path:line" of that line.
  std::string place_before(std::size_t end) const;

 private:
  void join_continued_lines();
  void drop_loose_slashes(std::size_t begin, std::size_t end);
  void read_statement(std::size_t begin, std::size_t end);
  std::size_t line_number(std::size_t offset) const;

  std::string path_;
  std::string text_;
  std::vector<std::size_t> joined_;  // offsets of line breaks that became blanks
  std::vector<std::string> mtllibs_;
  std::map<std::string, std::size_t> ignored_;
  std::uint64_t hash_ = 0;
};

/// CR LF becomes blank LF, a lone CR becomes LF: nothing moves.
void unify_line_breaks(std::string& text);

/// Without blanks (spaces, tabs, carriage returns) at either end.
std::string_view trim(std::string_view text);

}  // namespace octolux
