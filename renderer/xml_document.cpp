// Reading, substitution and resolution of references. The sole user of pugixml.
//
// As in Mitsuba, a file is worked through from top to bottom: a <default> counts from where it
// stands, inside included files too and after them; the first one wins, and -D wins over all.
// Invariant of a finished document: every <ref> has a target, and no object contains itself.
#include "renderer/xml_document.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <optional>
#include <pugixml.hpp>
#include <set>

#include "core/error.h"
#include "core/file_io.h"
#include "core/hash.h"
#include "renderer/xml_grammar.h"
#include "renderer/xml_references.h"

namespace octolux {
namespace fs = std::filesystem;

void fail(const Location& where, const std::string& message) {
  throw Error(where.file + ":" + std::to_string(where.line) + ": " + message);
}

const std::string* XmlNode::attribute(std::string_view name) const {
  for (const auto& [key, value] : attributes) {
    if (key == name) return &value;
  }
  return nullptr;
}

const std::string& XmlNode::required(std::string_view name) const {
  const std::string* value = attribute(name);
  if (!value) fail(where, "<" + tag + "> needs the attribute '" + std::string(name) + "'");
  return *value;
}

std::string parameter_name(std::string_view name) {
  std::string result;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const auto is_upper = [&](std::size_t k) {
      return std::isupper(static_cast<unsigned char>(name[k])) != 0;
    };
    if (i > 0 && is_upper(i) && !is_upper(i - 1) && name[i - 1] != '_') result += '_';
    result += static_cast<char>(std::tolower(static_cast<unsigned char>(name[i])));
  }
  return result;
}

/// Fills one XmlDocument.
class XmlReader {
 public:
  XmlReader(XmlDocument& document, const std::map<std::string, std::string>& defines)
      : document_(document), parameters_(defines) {
    for (const auto& [name, value] : defines) {
      unused_defines_.insert(name);
      add_to_hash(name + "=" + value);
    }
  }

  XmlNode read_file(const std::string& path, const std::string& shown_at);
  void check_defines(const std::string& path) const;

 private:
  /// A file, and where its lines end, so that a place is found without counting from the top.
  struct Source {
    Source(std::string path_, std::string text_) : path(std::move(path_)), text(std::move(text_)) {
      for (auto at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + 1)) {
        line_ends.push_back(static_cast<std::ptrdiff_t>(at));
      }
    }
    Location locate(std::ptrdiff_t offset) const {
      const auto next = std::lower_bound(line_ends.begin(), line_ends.end(), offset);
      return {path, 1 + static_cast<int>(next - line_ends.begin())};
    }

    std::string path;
    std::string text;
    std::vector<std::ptrdiff_t> line_ends;
  };

  void add_to_hash(std::string_view bytes) { document_.hash_ = hash_bytes(document_.hash_, bytes); }
  XmlNode read_node(const pugi::xml_node& xml, const Source& source);
  void read_child(const pugi::xml_node& xml, const Source& source, XmlNode& parent);
  void include(const XmlNode& directive, XmlNode& parent);
  void add_search_path(const XmlNode& directive);
  void add_default(const XmlNode& directive);
  std::string substitute(const std::string& text, const Location& where);
  [[noreturn]] void fail_unknown_parameter(const std::string& text, const Location& where) const;

  XmlDocument& document_;
  std::map<std::string, std::string> parameters_;
  std::set<std::string> unused_defines_;
  std::vector<std::string> open_files_;  // canonical; to notice cycles
};

XmlNode XmlReader::read_file(const std::string& path, const std::string& shown_at) {
  const std::string canonical = fs::weakly_canonical(path).string();
  if (std::count(open_files_.begin(), open_files_.end(), canonical) > 0) {
    throw Error(shown_at + "the file includes itself: '" + path + "'");
  }
  const Source source(path, octolux::read_file(path));
  add_to_hash(source.text);

  pugi::xml_document xml;
  const pugi::xml_parse_result parsed = xml.load_buffer(source.text.data(), source.text.size());
  if (!parsed) {
    fail(source.locate(parsed.offset), std::string("malformed XML: ") + parsed.description());
  }
  open_files_.push_back(canonical);
  XmlNode root = read_node(xml.document_element(), source);
  open_files_.pop_back();
  return root;
}

void XmlReader::check_defines(const std::string& path) const {
  if (unused_defines_.empty()) return;
  std::vector<std::string> names;
  for (const auto& [name, value] : parameters_) {
    if (unused_defines_.count(name) == 0) names.push_back(name);
  }
  throw Error(path + ": " + unknown_name("-D parameter", *unused_defines_.begin(), names));
}

XmlNode XmlReader::read_node(const pugi::xml_node& xml, const Source& source) {
  XmlNode node;
  node.where = source.locate(xml.offset_debug());
  node.tag = xml.name();
  for (const pugi::xml_attribute& attribute : xml.attributes()) {
    node.attributes.emplace_back(attribute.name(), substitute(attribute.value(), node.where));
  }
  check_grammar(node);
  for (const pugi::xml_node& child : xml.children()) read_child(child, source, node);
  return node;
}

void XmlReader::read_child(const pugi::xml_node& xml, const Source& source, XmlNode& parent) {
  if (xml.type() == pugi::node_pcdata || xml.type() == pugi::node_cdata) {
    const std::size_t begin = static_cast<std::size_t>(xml.offset_debug());
    const std::size_t word = source.text.find_first_not_of(" \t\r\n", begin);
    fail(source.locate(static_cast<std::ptrdiff_t>(word)),
         "unexpected text inside <" + parent.tag + ">");
  }
  if (xml.type() != pugi::node_element) return;
  if (is_ignored_tag(xml.name())) {
    const std::string warning = std::string("<") + xml.name() + "> elements are ignored";
    auto& warnings = document_.warnings_;
    if (std::count(warnings.begin(), warnings.end(), warning) == 0) warnings.push_back(warning);
    return;
  }
  XmlNode node = read_node(xml, source);
  if (node.tag == "include") return include(node, parent);
  if (node.tag == "path") return add_search_path(node);
  if (node.tag == "default") return add_default(node);
  parent.children.push_back(std::move(node));
}

void XmlReader::include(const XmlNode& directive, XmlNode& parent) {
  const std::string name = directive.required("filename");
  const std::string path = document_.find_file(name, directive.where).path;
  XmlNode root =
      read_file(path, directive.where.file + ":" + std::to_string(directive.where.line) + ": ");
  if (root.tag != "scene") return parent.children.push_back(std::move(root));
  for (XmlNode& child : root.children) parent.children.push_back(std::move(child));
}

void XmlReader::add_search_path(const XmlNode& directive) {
  const std::string& value = directive.required("value");
  const fs::path folder = fs::path(directive.where.file).parent_path() / value;
  if (!fs::is_directory(folder)) fail(directive.where, "no such folder: '" + value + "'");
  document_.search_path_.push_back(folder.string());
}

void XmlReader::add_default(const XmlNode& directive) {
  const std::string& name = directive.required("name");
  parameters_.emplace(name, directive.required("value"));
  unused_defines_.erase(name);
}

void XmlReader::fail_unknown_parameter(const std::string& text, const Location& where) const {
  const auto in_name = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
  const auto end = std::find_if_not(text.begin(), text.end(), in_name);
  std::vector<std::string> names;
  for (const auto& parameter : parameters_) names.push_back(parameter.first);
  fail(where, unknown_name("scene parameter", std::string(text.begin(), end), names) +
                  "; set one by <default> or -D");
}

std::string XmlReader::substitute(const std::string& text, const Location& where) {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    if (text[i] != '$') {
      result += text[i++];
      continue;
    }
    // The longest parameter that fits, so that $resx_half and $resx can both exist.
    const std::pair<const std::string, std::string>* best = nullptr;
    for (const auto& parameter : parameters_) {
      const std::string& name = parameter.first;
      if (name.empty() || text.compare(i + 1, name.size(), name) != 0) continue;
      if (!best || name.size() > best->first.size()) best = &parameter;
    }
    if (!best) fail_unknown_parameter(text.substr(i + 1), where);
    result += best->second;
    unused_defines_.erase(best->first);
    i += 1 + best->first.size();
  }
  return result;
}

XmlDocument::XmlDocument(const std::string& path,
                         const std::map<std::string, std::string>& defines) {
  XmlReader reader(*this, defines);
  search_path_.push_back(fs::path(path).parent_path().string());
  root_ = reader.read_file(path, "");
  if (root_.tag != "scene") fail(root_.where, "expected <scene>, found <" + root_.tag + ">");
  reader.check_defines(path);

  resolve_references(root_);
}

std::vector<std::string> XmlDocument::folders_for(const Location& where) const {
  std::vector<std::string> folders{fs::path(where.file).parent_path().string()};
  // Later <path>s win, as in Mitsuba.
  folders.insert(folders.end(), search_path_.rbegin(), search_path_.rend());
  folders.erase(std::unique(folders.begin(), folders.end()), folders.end());
  return folders;
}

bool XmlDocument::has_file(const std::string& name, const Location& where) const {
  return octolux::find_file(folders_for(where), name).has_value();
}

FoundFile XmlDocument::find_file(const std::string& name, const Location& where) const {
  const std::vector<std::string> folders = folders_for(where);
  if (const std::optional<FoundFile> found = octolux::find_file(folders, name)) return *found;
  std::string searched;
  for (const std::string& folder : folders) {
    searched += (searched.empty() ? "" : ", ") + (folder.empty() ? "." : folder);
  }
  fail(where, "file not found: '" + name + "'; searched in " + searched);
}

}  // namespace octolux
