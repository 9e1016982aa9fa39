// The solver's inner loop: the same bits with AVX2 and without, and a fixed point where all rows hold.
#include "engine/sim/solve_rows.h"

#include <catch2/catch.hpp>
#include <cstring>
#include <vector>

#include "engine/base/random.h"

using namespace stampede;

namespace {

// Contacts between a mover of two quads and one of three, with all kinds of rows, and joints.
struct Rows {
  explicit Rows(RandomKey key) : random(key), velocities(5) {
    for (Quad& quad : velocities)
      for (double& value : quad.v) value = random.between(-1, 1);
    for (int i = 0; i < 6; ++i) {
      SolverContact contact;
      contact.normal = static_cast<int>(rows.size());
      for (int k = 0; k < 6; ++k) add(rows, i % 3);
      contact.friction = 0.7;
      if (i % 2 == 0) {
        contact.spin = contact.normal + 3;
        contact.roll = contact.normal + 4;
        contact.spinning = contact.rolling = 0.05;
      }
      rows[static_cast<std::size_t>(contact.normal)].lower = 0;
      contacts.push_back(contact);
    }
    for (int i = 0; i < 3; ++i) add(joints, 1);
  }

  void add(std::vector<SolverRow>& to, int which) {  // 0: the first mover alone, 1: the second alone, 2: both
    SolverRow row;
    row.numbers = static_cast<int>(numbers.size());
    row.at[0] = which == 1 ? 2 : 0;
    row.quads[0] = which == 1 ? 3 : 2;
    row.at[1] = 2;
    row.quads[1] = which == 2 ? 3 : 0;
    for (const int quads : row.quads)
      for (int part = 0; part < 2; ++part)  // J and, of a unit mass, the same as its response
        for (int k = 0; k < quads; ++k) {
          Quad quad;
          for (int lane = 0; lane < 4; ++lane) {
            quad.v[lane] =
                part == 0 ? random.between(-1, 1) : numbers[numbers.size() - static_cast<std::size_t>(quads)].v[lane];
            if (part == 0) row.response += quad.v[lane] * quad.v[lane];
          }
          numbers.push_back(quad);
        }
    row.response_inverse = 1 / row.response;
    row.target = random.between(-0.1, 0.1);
    over_response(numbers.data(), row);
    row.lower = -1;
    row.upper = 1;
    to.push_back(row);
  }

  SolverIsland island() {
    return {numbers.data(),  velocities.data(), rows.data(), joints.data(), contacts.data(), 3,
            contacts.size(), joints.size()};
  }

  Random random;
  std::vector<Quad> numbers, velocities;
  std::vector<SolverRow> rows, joints;
  std::vector<SolverContact> contacts;
};

}  // namespace

TEST_CASE("rows are solved to the same bits with AVX2 and without", "[sim]") {
  if (solve_rows_avx2() == nullptr) return;  // nothing to compare with
  for (int seed = 0; seed < 20; ++seed) {
    Rows plain(RandomKey("rows").with(seed)), wide(RandomKey("rows").with(seed));
    for (int i = 0; i < 30; ++i) {
      const double one = solve_rows_plain(plain.island(), i % 2 == 0);
      const double other = solve_rows_avx2()(wide.island(), i % 2 == 0);
      CHECK(one == other);
    }
    CHECK(std::memcmp(plain.velocities.data(), wide.velocities.data(), plain.velocities.size() * sizeof(Quad)) == 0);
  }
}

TEST_CASE("iterations lead to speeds that satisfy every row within its bounds", "[sim]") {
  Rows rows(RandomKey("settled"));
  double change = 1;
  for (int i = 0; i < 20000 && change > 1e-12; ++i) change = solve_rows_plain(rows.island(), i % 2 == 0);
  REQUIRE(change <= 1e-12);
  for (const SolverContact& contact : rows.contacts) {
    const SolverRow& normal = rows.rows[static_cast<std::size_t>(contact.normal)];
    const double miss = (speed(rows.numbers.data(), rows.velocities.data(), normal) - normal.target) * normal.response;
    CHECK(normal.impulse >= 0);
    CHECK(normal.impulse <= 1);
    if (normal.impulse > 0 && normal.impulse < 1) CHECK(miss == Approx(0).margin(1e-9));
    if (normal.impulse == 0) CHECK(miss > -1e-9);  // it parts
    const double one = rows.rows[static_cast<std::size_t>(contact.normal) + 1].impulse;
    const double other = rows.rows[static_cast<std::size_t>(contact.normal) + 2].impulse;
    CHECK(std::hypot(one, other) <= contact.friction * normal.impulse + 1e-12);
  }
}
