# Writes OUTPUT, the source of renderer/source_fingerprint.h, from the contents of FILES.
set(sums "")
foreach(file ${FILES})
  file(SHA256 ${file} sum)
  string(APPEND sums "${sum}\n")
endforeach()
string(SHA256 sum "${sums}")
string(SUBSTRING ${sum} 0 16 sum)
file(WRITE ${OUTPUT} "// Made by tools/fingerprint.cmake.
#include \"renderer/source_fingerprint.h\"
const char* octolux::source_fingerprint() { return \"${sum}\"; }
")
