// The table of elements. Attributes are optional here; whoever needs one asks XmlNode::required.
#include "renderer/xml_grammar.h"

#include <algorithm>
#include <iterator>

#include "core/error.h"

namespace octolux {
namespace {

struct Element {
  const char* tag;
  const char* attributes;  // separated by spaces
  bool object = false;
};

constexpr Element kElements[] = {
    {"scene", "version"},
    {"default", "name value"},
    {"include", "filename"},
    {"path", "value"},
    {"alias", "id as"},
    {"ref", "id name"},

    {"bsdf", "type id name", true},
    {"emitter", "type id name", true},
    {"film", "type id name", true},
    {"integrator", "type id name", true},
    {"rfilter", "type id name", true},
    {"sampler", "type id name", true},
    {"sensor", "type id name", true},
    {"shape", "type id name", true},
    {"texture", "type id name", true},

    {"boolean", "name value"},
    {"float", "name value"},
    {"integer", "name value"},
    {"string", "name value"},
    {"point", "name value x y z"},
    {"vector", "name value x y z"},
    {"color", "name value"},
    {"rgb", "name value intent"},
    {"srgb", "name value intent"},
    {"spectrum", "name value intent type"},
    {"blackbody", "name temperature scale"},

    {"transform", "name"},
    {"translate", "value x y z"},
    {"scale", "value x y z"},
    {"rotate", "value x y z angle"},
    {"matrix", "value"},
    {"lookat", "origin target up"},
    {"lookAt", "origin target up"},
};

std::vector<std::string> split(const std::string& words) {
  std::vector<std::string> result;
  for (std::size_t begin = 0; begin < words.size();) {
    const std::size_t end = std::min(words.find(' ', begin), words.size());
    result.push_back(words.substr(begin, end - begin));
    begin = end + 1;
  }
  return result;
}

const Element* find_element(std::string_view tag) {
  const auto* found = std::find_if(std::begin(kElements), std::end(kElements),
                                   [&](const Element& e) { return e.tag == tag; });
  return found == std::end(kElements) ? nullptr : found;
}

}  // namespace

void check_grammar(const XmlNode& node) {
  const Element* element = find_element(node.tag);
  if (!element) {
    std::vector<std::string> tags;
    for (const Element& e : kElements) tags.push_back(e.tag);
    fail(node.where, unknown_name("element", node.tag, tags));
  }
  const std::vector<std::string> legal = split(element->attributes);
  for (const auto& [name, value] : node.attributes) {
    if (std::find(legal.begin(), legal.end(), name) == legal.end()) {
      fail(node.where, unknown_name("<" + node.tag + "> attribute", name, legal));
    }
  }
}

bool is_ignored_tag(std::string_view tag) { return tag == "mode" || tag == "hide"; }

bool is_object_tag(std::string_view tag) {
  const Element* element = find_element(tag);
  return element && element->object;
}

}  // namespace octolux
