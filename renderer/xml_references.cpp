// Ids are unique over all files of a scene; a reference may stand before or after what it names.
#include "renderer/xml_references.h"

#include <map>
#include <set>

#include "core/error.h"

namespace octolux {
namespace {

/// <ref>s and <alias>es looked up among all ids.
class References {
 public:
  void collect(XmlNode& node) {
    for (XmlNode& child : node.children) collect(child);
    const std::string* id = is_object_tag(node.tag) ? node.attribute("id") : nullptr;
    if (id) add(*id, node, node.where);
  }

  /// Aliases may name aliases above them.
  void collect_aliases(const XmlNode& root) {
    for (const XmlNode& node : root.children) {
      if (node.tag == "alias") add(node.required("as"), find(node), node.where);
    }
  }

  void resolve(XmlNode& node) const {
    for (XmlNode& child : node.children) {
      if (child.tag == "ref") child.target = &find(child);
      resolve(child);
    }
  }

 private:
  void add(const std::string& id, const XmlNode& node, const Location& where) {
    const auto [entry, added] = objects_.emplace(id, &node);
    if (added) return;
    const Location& first = entry->second->where;
    fail(where, "the id '" + id + "' is taken; first used in " + first.file + ":" +
                    std::to_string(first.line));
  }

  const XmlNode& find(const XmlNode& ref) const {
    const std::string& id = ref.required("id");
    const auto found = objects_.find(id);
    if (found != objects_.end()) return *found->second;
    std::vector<std::string> ids;
    for (const auto& entry : objects_) ids.push_back(entry.first);
    fail(ref.where, unknown_name("id", id, ids));
  }

  std::map<std::string, const XmlNode*> objects_;
};

/// Throws Error if an object reaches itself through references.
class CycleCheck {
 public:
  void visit(const XmlNode& node) {
    if (done_.count(&node) > 0) return;
    open_.insert(&node);
    for (const XmlNode& child : node.children) {
      const XmlNode& next = child.object();
      if (open_.count(&next) > 0) {
        fail(child.where, "the reference to '" + child.required("id") + "' leads back to itself");
      }
      visit(next);
    }
    open_.erase(&node);
    done_.insert(&node);
  }

 private:
  std::set<const XmlNode*> open_, done_;
};

}  // namespace

void resolve_references(XmlNode& root) {
  References references;
  references.collect(root);
  references.collect_aliases(root);
  references.resolve(root);
  CycleCheck().visit(root);
}

}  // namespace octolux
