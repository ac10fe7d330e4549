// Everything a picture is made from. Owns all of it; the passes hold it by const reference.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "accel/ray_caster.h"
#include "core/bsdf.h"
#include "core/camera.h"
#include "core/filter.h"
#include "core/light.h"
#include "core/light_portal.h"
#include "core/shape.h"
#include "core/texture.h"
#include "renderer/focus.h"
#include "renderer/load_progress.h"

namespace octolux {

struct Scene {
  std::vector<Shape> shapes;
  std::vector<Instance> instances;  // of those shapes that belong to groups; they do not emit
  std::vector<std::unique_ptr<Bsdf>> bsdfs;
  std::vector<std::unique_ptr<Texture>> textures;
  std::vector<std::unique_ptr<Light>> lights;
  std::vector<const EnvironmentLight*> environment;  // those of `lights`; rays that escape see all
  std::vector<TriangleMesh> portals;  // where light from far away comes in; no surfaces

  CameraConfig camera_config;
  FilmSize film;
  Filter filter;
  Camera camera;

  /// Longest light path in segments, camera to light, straight transmissions included (Mitsuba's
  /// maxDepth: 1 is visible lights only, 2 direct light). -1 for no limit.
  int max_depth = -1;
  /// Does this file's integrator hide directly visible emitters (Mitsuba's hideEmitters)?
  bool hide_emitters = false;

  std::uint64_t hash = 0;             // of all files read and of -D values
  std::vector<std::string> warnings;  // what was ignored or assumed while loading
  std::vector<std::string> notes;     // what the file asked for by a name alone

  // Built by complete():
  std::unique_ptr<RayCaster> caster;
  // Per shape, as hits number them (RayHit), so those of instances too:
  std::vector<const Bsdf*> bsdf_of_shape;
  std::vector<const AreaLight*> area_light_of_shape;  // or nullptr
  Bounds bounds;
  std::optional<Focus> focus;     // of light from far away, if that is a small part of the scene
  double total_area = 0;          // of all shapes, at every instance [m^2]
  bool any_pass_through = false;  // some BSDF passes light straight on
  bool any_specular = false;      // some BSDF has a specular lobe, so caustics are possible

  const Bsdf& bsdf(std::uint32_t shape) const { return *bsdf_of_shape[shape]; }

  /// Builds what follows from the lists above. Call once after loading; then nothing may change.
  void complete(const LoadProgress& progress = {});
  /// Where photons are sought instead of where complete() found; or nowhere.
  void set_focus(const std::optional<Focus>& wanted);

 private:
  void add_placed_shapes();
  void aim_lights();
  void place_lights();

  std::unique_ptr<Portals> aims_;  // `portals`, as lights use them
};

}  // namespace octolux
