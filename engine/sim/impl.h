// What a World is made of. Private to engine/sim.
#pragma once

#include "engine/sim/anchors.h"
#include "engine/sim/command_log.h"
#include "engine/sim/dynamics.h"
#include "engine/sim/mechanisms.h"
#include "engine/sim/robot_control.h"
#include "engine/sim/world.h"

namespace stampede {

struct World::Impl {
  explicit Impl(std::shared_ptr<const Scene> scene_in);

  void check_robot(int robot) const;  // throws Error for an index that the scene does not have
  void step();
  void move_mechanisms();
  bool strained() const;
  void read_efforts();
  void place(int body, const Transform& world_from_body);  // snapshot.cpp
  void forget_pairs(int body);
  void canonicalise();
  void start_anew(ContactPoints kept);

  std::shared_ptr<const Scene> scene;
  StepClock clock;
  ContactFinder finder;
  Dynamics dynamics;
  Bodies bodies;
  ContactWindow contacts;
  RobotControl control;
  std::vector<Mechanism> mechanisms;
  AnchorNormals anchors;
  std::vector<std::vector<double>> efforts;  // body + 1, part
  bool canonical = false;                    // nothing moved since the last boundary
  CommandLog log;
  bool keeps_log = true;
};

}  // namespace stampede
