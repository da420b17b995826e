// Small missions and worlds for bad input: each is valid except for the mistake that a test adds.
#pragma once

#include <string>

namespace swiftlet::commands {

/// The leaves stand from line 4 on, indented by six.
inline std::string missionWith(const std::string& leaves) {
  return "<root BTCPP_format=\"4\" main_tree_to_execute=\"Main\">\n"
         "  <BehaviorTree ID=\"Main\">\n"
         "    <Sequence>\n" +
         leaves +
         "    </Sequence>\n"
         "  </BehaviorTree>\n"
         "</root>\n";
}

/// A box-shaped model with its middle at `pose` ("x y z roll pitch yaw").
inline std::string box(const std::string& name, const std::string& pose, const std::string& size) {
  return "    <model name=\"" + name + "\">\n      <static>true</static>\n      <pose>" + pose +
         "</pose>\n      <link name=\"link\">\n        <collision name=\"c\"><geometry><box><size>" + size +
         "</size></box></geometry></collision>\n"
         "        <visual name=\"v\"><geometry><box><size>" +
         size + "</size></box></geometry></visual>\n      </link>\n    </model>\n";
}

inline std::string worldWith(const std::string& models) {
  return "<?xml version=\"1.0\"?>\n<sdf version=\"1.9\">\n  <world name=\"w\">\n" + models + "  </world>\n</sdf>\n";
}

inline std::string floorBox() { return box("floor", "0 0 -0.05 0 0 0", "20 20 0.1"); }
/// A room of 6 m by 6 m about the origin.
inline std::string room() {
  return floorBox() + box("north", "0 3 1.25 0 0 0", "6 0.2 2.5") + box("south", "0 -3 1.25 0 0 0", "6 0.2 2.5") +
         box("east", "3 0 1.25 0 0 0", "0.2 6 2.5") + box("west", "-3 0 1.25 0 0 0", "0.2 6 2.5");
}

inline const std::string kHop = "      <TakeOff height_m=\"1.0\"/>\n      <Land/>\n";

}  // namespace swiftlet::commands
