// result.h.
#include "tools/ab/result.h"

namespace octolux {

void measure(AbResult& result) {
  const LayerView reference = view_layer(result.reference);
  result.masks = leak_masks(result.seen, reference);
  for (AbPicture& p : result.pictures) {
    const LayerView image = view_layer(p.picture);
    p.masks.clear();
    for (const NamedMask& m : result.masks) {
      p.masks.push_back({measure_leaks(reference, image, m.mask),
                         compare_layers(reference, image, m.mask, CompareOptions{})});
    }
  }
}

}  // namespace octolux
