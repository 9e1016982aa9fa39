// What an episode does to joints, contacts and the arm: measured by simulating its commands again, step by step.
#pragma once

#include <string>
#include <vector>

#include "engine/record/record.h"

namespace stampede::test {

// The worst of one kind, and where it was seen.
struct Worst {
  double value = 0;
  std::string where;
  void meet(double other, const std::string& place) {
    if (other > value) value = other, where = place;
  }
};

struct Strain {
  Worst beyond_m, beyond_rad;  // joints beyond their stops
  Worst force;                 // of a contact, in one step, N
  double median_force = 0;     // of the peaks of all contacts, N
  Worst depth;                 // overlap of two shapes that lasts three frames (what lands is deep for some steps), m
  Worst free_force;            // of the robot, or what it holds, in free motions, N
  Worst tool_speed;            // m/s
  Worst end_speed;             // of a joint of the arm where a skill ends, rad/s
  Worst slip;                  // of a held thing in the hand, from its grasp to its release, m
  double saturated = 0;        // share of the steps at which a motor of the arm gives all it has
  double seconds = 0;          // simulated
};

Strain strain_of(const EpisodeRecord& episode);
std::string to_text(const Strain& strain);  // one line a kind

}  // namespace stampede::test
