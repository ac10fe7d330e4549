// Lookup and bookkeeping of an object's parameters.
#include "renderer/properties.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"

namespace octolux {

Properties::Properties(const XmlNode& node) : node_(node) {
  for (const XmlNode& child : node.children) {
    const std::string* name = child.attribute("name");
    if (!name && !is_object_tag(child.object().tag)) {
      octolux::fail(child.where, "<" + child.tag + "> cannot stand inside <" + node.tag +
                                     ">, or needs the attribute 'name'");
    }
    Entry added{name ? parameter_name(*name) : "", &child};
    const auto same = std::find_if(entries_.begin(), entries_.end(),
                                   [&](const Entry& e) { return name && e.name == added.name; });
    if (same != entries_.end()) {
      octolux::fail(child.where, "the parameter '" + *name + "' is given twice; first in line " +
                                     std::to_string(same->node->where.line));
    }
    entries_.push_back(std::move(added));
  }
}

const Location& Properties::where(const std::string& name) const {
  for (const Entry& e : entries_) {
    if (e.name == name) return e.node->where;
  }
  return node_.where;
}

void Properties::fail(const std::string& name, const std::string& message) const {
  octolux::fail(where(name), message);
}

Properties::Entry* Properties::entry(const std::string& name) {
  asked_for_.push_back(name);
  for (Entry& e : entries_) {
    if (e.name != name) continue;
    e.used = true;
    return &e;
  }
  return nullptr;
}

const XmlNode* Properties::find(const std::string& name) {
  const Entry* found = entry(name);
  return found ? found->node : nullptr;
}

const XmlNode* Properties::value(const std::string& name, std::initializer_list<const char*> tags) {
  const XmlNode* found = find(name);
  if (!found) return nullptr;
  std::string expected;
  for (const char* tag : tags) {
    if (found->tag == tag) return found;
    expected += (expected.empty() ? "<" : " or <") + std::string(tag) + ">";
  }
  octolux::fail(found->where, "the parameter '" + name + "' is <" + found->object().tag +
                                  ">, expected " + expected);
}

std::optional<float> Properties::number(const std::string& name) {
  const XmlNode* found = value(name, {"float", "integer"});
  if (!found) return std::nullopt;
  const double number = parse_number(found->required("value"), found->where);
  if (std::abs(number) > std::numeric_limits<float>::max()) {
    fail(name, "'" + name + "' is out of range");
  }
  return static_cast<float>(number);
}

std::optional<int> Properties::integer(const std::string& name) {
  const XmlNode* found = value(name, {"integer"});
  if (!found) return std::nullopt;
  const long long number = parse_integer(found->required("value"), found->where);
  if (number < std::numeric_limits<int>::min() || number > std::numeric_limits<int>::max()) {
    fail(name, "'" + name + "' is out of range");
  }
  return static_cast<int>(number);
}

std::optional<bool> Properties::boolean(const std::string& name) {
  const XmlNode* found = value(name, {"boolean"});
  if (!found) return std::nullopt;
  return parse_boolean(found->required("value"), found->where);
}

std::optional<std::string> Properties::text(const std::string& name) {
  const XmlNode* found = value(name, {"string"});
  if (!found) return std::nullopt;
  return found->required("value");
}

std::optional<Vec3> Properties::point(const std::string& name) {
  const XmlNode* found = value(name, {"point", "vector"});
  if (!found) return std::nullopt;
  return parse_vector(*found);
}

std::optional<Rgb> Properties::color(const std::string& name, ColorRole role) {
  const XmlNode* found = value(name, {"rgb", "spectrum", "srgb", "color", "float"});
  if (!found) return std::nullopt;
  return parse_color(*found, role);
}

Affine Properties::transform(const std::string& name) {
  const XmlNode* found = value(name, {"transform"});
  if (!found) return {};
  const Affine result = parse_transform(*found);
  if (!result.inverse()) fail(name, "the transform '" + name + "' is singular");
  return result;
}

float Properties::positive(const std::string& name, float fallback) {
  const float result = number(name).value_or(fallback);
  if (!(result > 0)) fail(name, "'" + name + "' must be above 0");
  return result;
}

std::string Properties::choice(const std::string& name, const std::vector<std::string>& legal) {
  const std::string result = text(name).value_or(legal.front());
  if (std::find(legal.begin(), legal.end(), result) == legal.end()) {
    fail(name, unknown_name(name, result, legal));
  }
  return result;
}

std::vector<const XmlNode*> Properties::objects(const std::string& tag) {
  asked_for_.push_back("<" + tag + ">");
  std::vector<const XmlNode*> result;
  for (Entry& e : entries_) {
    if (e.used || e.node->object().tag != tag) continue;
    e.used = true;
    result.push_back(&e.node->object());
  }
  return result;
}

void Properties::ignore(std::initializer_list<const char*> names) {
  for (const char* name : names) entry(name);
}

bool Properties::take(const std::string& name) {
  for (Entry& e : entries_) {
    if (e.name != name || e.used) continue;
    return e.used = true;
  }
  return false;
}

void Properties::ignore_rest() {
  for (Entry& e : entries_) e.used = true;
}

void Properties::finish() const {
  std::vector<std::string> legal;
  for (const std::string& name : asked_for_) {
    if (name[0] != '<') legal.push_back(name);
  }
  for (const Entry& e : entries_) {
    if (e.used) continue;
    const std::string* type = node_.attribute("type");
    const std::string owner = type ? *type : node_.tag;
    if (e.name.empty()) {
      octolux::fail(e.node->where, "a " + e.node->object().tag + " cannot stand inside " +
                                       node_.tag + " '" + owner + "'");
    }
    octolux::fail(e.node->where,
                  unknown_name(owner + " parameter", *e.node->attribute("name"), legal));
  }
}

}  // namespace octolux
