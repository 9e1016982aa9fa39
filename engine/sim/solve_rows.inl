// Included by solve_rows_plain.cpp and solve_rows_avx2.cpp, each in a namespace of its own. Includes nothing itself.

typedef double Lanes __attribute__((vector_size(32)));

inline Lanes load(const Quad& quad) {
  Lanes lanes;
  __builtin_memcpy(&lanes, quad.v, sizeof lanes);
  return lanes;
}

inline void store(Quad& quad, const Lanes& lanes) { __builtin_memcpy(quad.v, &lanes, sizeof lanes); }

inline Lanes speed_of_side(const Quad* jacobian, const Quad* own, int quads) {
  Lanes sum = {0, 0, 0, 0};
  for (int k = 0; k < quads; ++k) sum += load(jacobian[k]) * load(own[k]);
  return sum;
}

// Each side has a sum of its own: what a row waits for is half as long.
inline double speed_of(const Quad* numbers, const Quad* velocities, const SolverRow& row) {
  const Quad* jacobian = numbers + row.numbers;
  const Lanes sum = speed_of_side(jacobian, velocities + row.at[0], row.quads[0]) +
                    speed_of_side(jacobian + 2 * row.quads[0], velocities + row.at[1], row.quads[1]);
  return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

inline void push_by(const Quad* numbers, Quad* velocities, const SolverRow& row, double impulse) {
  const Quad* response = numbers + row.numbers + row.quads[0];
  for (int side = 0; side < 2; ++side) {
    Quad* own = velocities + row.at[side];
    for (int k = 0; k < row.quads[side]; ++k) store(own[k], load(own[k]) + impulse * load(response[k]));
    response += row.quads[0] + row.quads[1];
  }
}

// The change of the impulse that gives the row the speed asked for.
inline double missing(const SolverIsland& island, const SolverRow& row) {
  return row.target - speed_of(island.numbers, island.velocities, row);
}

// By so much; the change of the row's speed.
inline double set_impulse(const SolverIsland& island, SolverRow& row, double impulse, double change) {
  if (change == 0) return 0;
  row.impulse = impulse;
  push_by(island.numbers, island.velocities, row, change);
  return (change < 0 ? -change : change) * row.response;
}

inline double greater(double a, double b) { return a < b ? b : a; }

inline double solve_row(const SolverIsland& island, SolverRow& row) {
  const double change = missing(island, row), impulse = row.impulse + change;
  if (impulse < row.lower) return set_impulse(island, row, row.lower, row.lower - row.impulse);
  if (impulse > row.upper) return set_impulse(island, row, row.upper, row.upper - row.impulse);
  return set_impulse(island, row, impulse, change);
}

// Two rows whose impulses together are at most `most`.
inline double solve_cone(const SolverIsland& island, SolverRow& row, SolverRow& other, double most) {
  if (most == 0 && row.impulse == 0 && other.impulse == 0) return 0;
  double changes[2] = {missing(island, row), missing(island, other)};
  double one = row.impulse + changes[0], two = other.impulse + changes[1];
  const double squared = one * one + two * two;
  if (squared > most * most) {
    const double scale = most / __builtin_sqrt(squared);
    one *= scale;
    two *= scale;
    changes[0] = one - row.impulse;
    changes[1] = two - other.impulse;
  }
  const double change = set_impulse(island, row, one, changes[0]);
  return greater(change, set_impulse(island, other, two, changes[1]));
}

inline double solve_contacts(const SolverIsland& island, std::size_t begin, std::size_t end) {
  double most = 0;
  for (std::size_t i = begin; i < end; ++i)
    most = greater(most, solve_row(island, island.rows[island.contacts[i].normal]));
  for (std::size_t i = begin; i < end; ++i) {
    const SolverContact& contact = island.contacts[i];
    const double pressure = island.rows[contact.normal].impulse;
    if (contact.spin >= 0) {
      SolverRow& spin = island.rows[contact.spin];
      spin.upper = contact.spinning * pressure;
      spin.lower = -spin.upper;
      if (spin.upper != 0 || spin.impulse != 0) most = greater(most, solve_row(island, spin));
    }
    if (contact.roll >= 0) {
      SolverRow* roll = island.rows + contact.roll;
      most = greater(most, solve_cone(island, roll[0], roll[1], contact.rolling * pressure));
    }
  }
  for (std::size_t i = begin; i < end; ++i) {
    SolverRow* normal = island.rows + island.contacts[i].normal;
    most = greater(most, solve_cone(island, normal[1], normal[2], island.contacts[i].friction * normal->impulse));
  }
  return most;
}

inline double solve_all(const SolverIsland& island, bool forwards) {
  double most = solve_contacts(island, 0, island.link_contacts);
  for (std::size_t i = 0; i < island.joint_count; ++i)
    most = greater(most, solve_row(island, island.joints[forwards ? i : island.joint_count - 1 - i]));
  most = greater(most, solve_contacts(island, island.link_contacts, island.contact_count));
  for (std::size_t i = 0; i < island.bond_count; ++i)
    most = greater(most, solve_row(island, island.joints[island.joint_count + i]));
  return most;
}
