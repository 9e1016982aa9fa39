// Contact forces summed over the steps of one window.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/sim/world.h"

class btDispatcher;

namespace stampede {

class ContactWindow {
 public:
  // One pair's running sums: of forces in N over the steps of the open window.
  struct Sum {
    PartRef a, b;
    double normal = 0, peak = 0, step_normal = 0, depth = 0;
    std::int64_t step = 0;  // that step_normal belongs to
    Vector3 normal_vector = Vector3::Zero(), point = Vector3::Zero(), force = Vector3::Zero();
  };

  ContactWindow();
  void add_step(btDispatcher& dispatcher, double dt);  // reads what the solver applied in the step just made
  void close();
  const std::vector<Contact>& closed() const { return closed_; }
  // Calls visitor(a, b, point, direction of the force) for what touched in the closed window, and in the open one so
  // far.
  template <typename Visitor>
  void visit(const Visitor& visitor) const {
    for (const Contact& one : closed_) visitor(one.a, one.b, one.point, one.force.normalized());
    for (const Sum& sum : sums_) visitor(sum.a, sum.b, sum.point / sum.normal, sum.force.normalized());
  }
  std::optional<PartRef> grasped(const std::vector<int>& pads) const;

  // All of it is part of a snapshot.
  struct State {
    std::vector<Sum> open;
    std::int64_t steps = 0;
    std::vector<Contact> closed;
  };
  State state() const { return {sums_, steps_, closed_}; }
  void set_state(const State& state);

 private:
  Sum& sum_of(PartRef a, PartRef b);
  void index_sums(std::size_t table_size);
  std::vector<Sum> sums_;            // in order of first touch
  std::vector<std::int32_t> table_;  // open addressing: index in sums_, -1 empty
  std::int64_t steps_ = 0;           // in the open window
  std::vector<Contact> closed_;
};

}  // namespace stampede
