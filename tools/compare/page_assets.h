// The files of tools/compare/page, as CMake puts them into the program.
#pragma once

namespace octolux::page_assets {

extern const char kHtml[];
extern const char kStyle[];
extern const char kScript[];
extern const char kSelftest[];

}  // namespace octolux::page_assets
