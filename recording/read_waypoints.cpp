#include "recording/read_waypoints.h"

namespace umbsim {

std::vector<Waypoint> read_waypoints(const YamlValue& value, const Bounds& place_m) {
  std::vector<Waypoint> waypoints;
  for (const YamlValue& item : value.list()) {
    const std::vector<YamlValue> place = item.list();
    if (place.size() != 2) item.fail("a waypoint is two numbers, [x, y]");
    waypoints.push_back({place[0].number(place_m), place[1].number(place_m)});
  }
  return waypoints;
}

}  // namespace umbsim
