// A Mitsuba scene file as a plain tree: includes spliced in, `default`s and -D values substituted,
// references resolved, every node knowing its file and line. Which elements and attributes exist
// is checked here; what they mean is not.
//
// Both dialects (0.5/0.6 and 2/3) share one grammar. Parameter names are left as written; use
// `parameter_name` to compare them. Not thread-safe while loading, immutable afterwards.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "renderer/find_file.h"

namespace octolux {

struct Location {
  std::string file;
  int line = 0;
};

/// Throws Error "file:line: message".
[[noreturn]] void fail(const Location& where, const std::string& message);

struct XmlNode {
  Location where;
  std::string tag;
  std::vector<std::pair<std::string, std::string>> attributes;
  std::vector<XmlNode> children;
  const XmlNode* target = nullptr;  // of a <ref>: the object it names

  /// The attribute's value, or nullptr.
  const std::string* attribute(std::string_view name) const;
  /// The attribute's value, or an Error that says what is missing.
  const std::string& required(std::string_view name) const;
  /// The object: the target of a <ref>, otherwise this node.
  const XmlNode& object() const { return target ? *target : *this; }
};

class XmlDocument {
 public:
  /// Reads `path` and all it includes. Throws Error.
  XmlDocument(const std::string& path, const std::map<std::string, std::string>& defines);
  XmlDocument(const XmlDocument&) = delete;
  XmlDocument& operator=(const XmlDocument&) = delete;

  const XmlNode& root() const { return root_; }
  /// Elements left out because they change no pixel, one line each.
  const std::vector<std::string>& warnings() const { return warnings_; }
  /// Of the scene's XML files and of the defines.
  std::uint64_t hash() const { return hash_; }

  /// A file named at `where`: beside that file, or in the search path. If it is nowhere, a name
  /// that differs in case or has backslashes will do. Throws Error if there is none either.
  FoundFile find_file(const std::string& name, const Location& where) const;
  bool has_file(const std::string& name, const Location& where) const;

 private:
  friend class XmlReader;
  std::vector<std::string> folders_for(const Location& where) const;

  XmlNode root_;
  std::vector<std::string> search_path_;
  std::vector<std::string> warnings_;
  std::uint64_t hash_ = 0;
};

/// Canonical spelling of a parameter's name, snake_case: toWorld and to_world, intIOR and int_ior.
std::string parameter_name(std::string_view name);

/// Is this the tag of an object (bsdf, shape ...), as opposed to a value (float, rgb ...)?
bool is_object_tag(std::string_view tag);

}  // namespace octolux
