// The OpenColorIO configuration we ship (display.h says what its views are for). It is a string in
// the program, so that the program runs from anywhere. The ACES view is made of OpenColorIO's own
// built-in transforms; the matrix before it turns Rec.709 (D65) into ACES2065-1 (Bradford).
#include "core/display.h"

namespace octolux {

const char* shipped_display_config() {
  return R"(ocio_profile_version: 2

environment: {}
search_path: ""
strictparsing: true
name: octolux

roles:
  default: Linear Rec.709
  scene_linear: Linear Rec.709
  aces_interchange: ACES2065-1
  cie_xyz_d65_interchange: CIE XYZ-D65

file_rules:
  - !<Rule> {name: Default, colorspace: default}

displays:
  sRGB:
    - !<View> {name: Standard, colorspace: sRGB}
    - !<View> {name: ACES 1.0 SDR, view_transform: ACES 1.0 SDR, display_colorspace: sRGB Display}
    - !<View> {name: Raw, colorspace: Raw}

active_displays: [sRGB]
active_views: [Standard, ACES 1.0 SDR, Raw]

default_view_transform: ACES 1.0 SDR

view_transforms:
  - !<ViewTransform>
    name: ACES 1.0 SDR
    description: Academy output transform 1.0 for SDR video, through ACES2065-1
    from_scene_reference: !<GroupTransform>
      children:
        - !<ColorSpaceTransform> {src: Linear Rec.709, dst: ACES2065-1}
        - !<BuiltinTransform> {style: ACES-OUTPUT - ACES2065-1_to_CIE-XYZ-D65 - SDR-VIDEO_1.0}

display_colorspaces:
  - !<ColorSpace>
    name: CIE XYZ-D65
    description: Display reference space
    isdata: false

  - !<ColorSpace>
    name: sRGB Display
    description: Screen with sRGB primaries and curve
    isdata: false
    from_display_reference: !<BuiltinTransform> {style: DISPLAY - CIE-XYZ-D65_to_sRGB}

colorspaces:
  - !<ColorSpace>
    name: Linear Rec.709
    description: Scene-linear light with Rec.709 primaries, as in our EXR files
    isdata: false

  - !<ColorSpace>
    name: sRGB
    description: Rec.709 primaries with the sRGB curve
    isdata: false
    from_scene_reference: !<ExponentWithLinearTransform> {gamma: 2.4, offset: 0.055, direction: inverse}

  - !<ColorSpace>
    name: ACES2065-1
    description: Scene-linear light with ACES AP0 primaries
    isdata: false
    from_scene_reference: !<MatrixTransform> {matrix: [0.439632981919491, 0.382988698151554, 0.177378319928955, 0, 0.0897764429588424, 0.813439428748981, 0.0967841282921771, 0, 0.0175411703831727, 0.111546553302387, 0.87091227631444, 0, 0, 0, 0, 1]}

  - !<ColorSpace>
    name: Raw
    description: Numbers that are not colour
    isdata: true
)";
}

}  // namespace octolux
