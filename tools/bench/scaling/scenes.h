// Rooms made to measure: as many triangles, or as many lamps, as wanted. Written as scene files
// into a temporary folder, so that reading them is measured, too.
#pragma once

#include <cstdint>
#include <string>

namespace octolux {

/// Scene files that are removed with this.
class GeneratedRoom {
 public:
  GeneratedRoom(const GeneratedRoom&) = delete;
  GeneratedRoom& operator=(const GeneratedRoom&) = delete;
  ~GeneratedRoom();

  /// Of the XML file.
  std::string path() const { return folder_ + "/room.xml"; }

 protected:
  GeneratedRoom();
  /// `floor` is a shape of the XML file.
  void write(const std::string& floor, std::int64_t lamps) const;

  std::string folder_;
};

/// A room whose floor is a mesh of about `triangles` in waves (binary PLY), with one lamp.
struct WavyRoom : GeneratedRoom {
  explicit WavyRoom(std::int64_t triangles);
};

/// A room with `lamps` small area lights all over its ceiling, each a shape of its own; together
/// they have the same area and power, however many they are.
struct LampRoom : GeneratedRoom {
  explicit LampRoom(std::int64_t lamps);
};

}  // namespace octolux
