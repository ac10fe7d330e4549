// One pass over the bytes of an OBJ file before tinyobjloader reads them; see obj_text.h.
#include "renderer/obj_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/file_io.h"
#include "core/hash.h"

namespace octolux {

void unify_line_breaks(std::string& text) {
  for (std::size_t i = text.find('\r'); i != std::string::npos; i = text.find('\r', i + 1)) {
    text[i] = i + 1 < text.size() && text[i + 1] == '\n' ? ' ' : '\n';
  }
}

std::string_view trim(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\r\n") - begin + 1);
}

namespace {

/// Where a comment begins behind a statement's words, or its length. "1.#IND" is no comment.
std::size_t comment_start(std::string_view line) {
  for (std::size_t i = line.find('#'); i != std::string_view::npos; i = line.find('#', i + 1)) {
    if (line[i - 1] == ' ' || line[i - 1] == '\t') return i;
  }
  return line.size();
}

}  // namespace

ObjText::ObjText(const std::string& path) : path_(path), text_(read_file(path)) {
  hash_ = hash_bytes(0, text_);
  text_ += '\n';
  unify_line_breaks(text_);
  join_continued_lines();
  for (std::size_t begin = 0; begin < text_.size();) {
    const std::size_t end = text_.find('\n', begin);
    read_statement(begin, end);
    begin = end + 1;
  }
}

void ObjText::join_continued_lines() {
  for (std::size_t i = text_.find('\\'); i != std::string::npos; i = text_.find('\\', i + 1)) {
    const std::size_t end = text_.find_first_not_of(' ', i + 1);
    const bool last = end != std::string::npos && end + 1 == text_.size();
    if (end == std::string::npos || text_[end] != '\n' || last) continue;
    text_[i] = text_[end] = ' ';
    joined_.push_back(end);
  }
}

void ObjText::read_statement(std::size_t begin, std::size_t end) {
  begin = text_.find_first_not_of(" \t", begin);
  if (begin >= end || text_[begin] == '#') return;
  const std::size_t word_end = std::min(text_.find_first_of(" \t", begin), end);
  const std::string_view word(text_.data() + begin, word_end - begin);
  if (word == "v" || word == "vn" || word == "vt" || word == "f") {
    const std::size_t comment = begin + comment_start({text_.data() + begin, end - begin});
    std::fill_n(text_.begin() + static_cast<std::ptrdiff_t>(comment), end - comment, ' ');
    if (word == "f") drop_loose_slashes(begin, end);
  } else if (word == "mtllib") {
    const auto rest = trim({text_.data() + word_end, end - word_end});
    if (!rest.empty()) mtllibs_.emplace_back(rest);
  } else if (word != "usemtl" && word != "g" && word != "o" && word != "s") {
    const bool room = ignored_.size() < 8;  // a file that is no OBJ at all would fill pages
    if (room && !ignored_.contains(std::string(word))) ignored_.emplace(word, line_number(begin));
  }
}

/// "1/2/" is "1/2"; tinyobjloader would look for the normal in the next word.
void ObjText::drop_loose_slashes(std::size_t begin, std::size_t end) {
  char after = ' ';
  for (std::size_t i = end; i-- > begin;) {
    if (text_[i] == '/' && (after == ' ' || after == '\t')) text_[i] = ' ';
    after = text_[i];
  }
}

std::size_t ObjText::line_number(std::size_t offset) const {
  const auto breaks =
      std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(offset), '\n');
  const auto joins = std::lower_bound(joined_.begin(), joined_.end(), offset) - joined_.begin();
  return static_cast<std::size_t>(1 + breaks + joins);
}

std::string_view ObjText::line_before(std::size_t end) const {
  const std::size_t before = end < 2 ? std::string::npos : text_.rfind('\n', end - 2);
  const std::size_t begin = before == std::string::npos ? 0 : before + 1;
  return std::string_view(text_).substr(begin, end - 1 - begin);
}

std::string ObjText::place_before(std::size_t end) const {
  const std::string_view line = line_before(end);
  return fmt::format("{}:{}", path_,
                     line_number(static_cast<std::size_t>(line.data() - text_.data())));
}

}  // namespace octolux
