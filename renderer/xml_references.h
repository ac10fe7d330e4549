// Links <ref id> elements to the objects they name.
#pragma once

#include "renderer/xml_document.h"

namespace octolux {

/// Sets XmlNode::target of every <ref> below `root`. Throws Error for an unknown id, an id used
/// twice, and an object that contains itself. `root` must then stay where it is.
void resolve_references(XmlNode& root);

}  // namespace octolux
