// The parameters of one object of a scene file. Remembers which were asked for: what is left over
// at the end is a mistake in the file, and the names asked for are the legal ones.
//
// Names are given in snake_case here and match both dialects. Not thread-safe.
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "renderer/xml_values.h"

namespace octolux {

class Properties {
 public:
  /// `node` must outlive this. Throws Error if a parameter has no name or occurs twice.
  explicit Properties(const XmlNode& node);

  const XmlNode& node() const { return node_; }
  const std::string& type() const { return node_.required("type"); }
  /// Of the parameter if it is there, otherwise of the object.
  const Location& where(const std::string& name) const;
  /// Error at that place.
  [[noreturn]] void fail(const std::string& name, const std::string& message) const;

  std::optional<float> number(const std::string& name);
  std::optional<int> integer(const std::string& name);
  std::optional<bool> boolean(const std::string& name);
  std::optional<std::string> text(const std::string& name);
  std::optional<Vec3> point(const std::string& name);
  std::optional<Rgb> color(const std::string& name, ColorRole role);
  /// Identity if absent; Error if not invertible.
  Affine transform(const std::string& name);

  /// A number that must be above 0.
  float positive(const std::string& name, float fallback);
  /// One of `legal`, the first if absent.
  std::string choice(const std::string& name, const std::vector<std::string>& legal);

  /// The parameter as it stands, or nullptr.
  const XmlNode* find(const std::string& name);
  /// Nested objects (or targets of references) of this kind, named or not.
  std::vector<const XmlNode*> objects(const std::string& tag);

  /// These are legal but change no pixel.
  void ignore(std::initializer_list<const char*> names);
  /// The same for one; was it there? It is not listed among the legal names.
  bool take(const std::string& name);
  /// Whatever is left may stand there.
  void ignore_rest();

  /// Throws Error if a parameter or nested object has not been asked for.
  void finish() const;

 private:
  struct Entry {
    std::string name;  // snake_case; "" for a nested object without one
    const XmlNode* node = nullptr;
    bool used = false;
  };

  Entry* entry(const std::string& name);
  const XmlNode* value(const std::string& name, std::initializer_list<const char*> tags);

  const XmlNode& node_;
  std::vector<Entry> entries_;
  std::vector<std::string> asked_for_;
};

}  // namespace octolux
