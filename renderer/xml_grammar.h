// Which elements a Mitsuba scene file may contain, and which attributes they take.
#pragma once

#include <string>

#include "renderer/xml_document.h"

namespace octolux {

/// Throws Error with the legal names if the element or one of its attributes does not exist.
void check_grammar(const XmlNode& node);

/// Elements that only steer other programs.
bool is_ignored_tag(std::string_view tag);

}  // namespace octolux
