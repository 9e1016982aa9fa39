// Trees of links against what mechanics says of them.
#include "engine/sim/articulation.h"

#include <btBulletCollisionCommon.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "engine/base/random.h"
#include "engine/sim/bullet_convert.h"
#include "engine/sim/dynamics.h"
#include "tests/engine/sim/sim_scenes.h"

using namespace stampede;
using namespace stampede::testing;

namespace {

constexpr int kLinks = 7;

// Hinges, sliders and a screw in a row, and a branch; masses off their axes. A floating one: the first link is free.
struct Tree {
  explicit Tree(bool floating)
      : tree(translation(0.1, -0.2, 0.5) * Transform(Eigen::AngleAxisd(0.7, Vector3(1, 2, 3).normalized())), floating) {
    Random random(RandomKey("tree"));
    const auto number = [&](double most) { return random.between(-most, most); };
    for (int i = 0; i < kLinks; ++i) {
      Articulation::Link link;
      link.parent = i == 5 ? 2 : i - 1;
      link.kind = i == 1 || i == 4 ? JointKind::slider : i == 3 ? JointKind::fixed : JointKind::hinge;
      if (i == 6) link.kind = JointKind::screw, link.lead = 0.1;
      link.parent_from_joint = translation(number(0.3), number(0.3), number(0.3)) *
                               Transform(Eigen::AngleAxisd(number(3), Vector3(number(1), number(1), 1).normalized()));
      link.axis = Vector3(number(1), number(1), 1).normalized();
      link.mass = random.between(0.3, 2);
      link.centre = {number(0.1), number(0.1), number(0.1)};
      link.inertia = Vector3(0.01, 0.02, 0.025).asDiagonal();
      link.object = &objects[i];
      tree.add(link);
      links.push_back(link);
    }
    for (std::size_t i = 0; i < tree.position.size(); ++i) {
      tree.position[i] = number(1);
      tree.velocity[i] = number(2);
    }
    tree.place();
  }

  Vector3 centre_velocity(int link, const std::vector<double>& velocity) const {
    Vector3 sum = Vector3::Zero();
    tree.jacobian(link, centre(link), [&](int dof, const Vector3& linear, const Vector3&) {
      sum += velocity[static_cast<std::size_t>(dof)] * linear;
    });
    return sum;
  }
  Vector3 centre(int link) const {  // the object's frame is the link's here
    return from_bullet(objects[link].getWorldTransform()) * links[static_cast<std::size_t>(link)].centre;
  }
  double kinetic_energy() const {
    double energy = 0;
    for (int i = 0; i < kLinks; ++i) {
      Vector3 spin = Vector3::Zero();
      tree.jacobian(i, centre(i), [&](int dof, const Vector3&, const Vector3& angular) {
        spin += tree.velocity[static_cast<std::size_t>(dof)] * angular;
      });
      const Matrix3 turn = from_bullet(objects[i].getWorldTransform()).linear();
      const Vector3 local = turn.transpose() * spin;
      const Articulation::Link& link = links[static_cast<std::size_t>(i)];
      energy +=
          0.5 * link.mass * centre_velocity(i, tree.velocity).squaredNorm() + 0.5 * local.dot(link.inertia * local);
    }
    return energy;
  }
  double potential_energy(double g) const {
    double energy = 0;
    for (int i = 0; i < kLinks; ++i) energy += links[static_cast<std::size_t>(i)].mass * g * centre(i).z();
    return energy;
  }

  btCollisionObject objects[kLinks];
  std::vector<Articulation::Link> links;
  Articulation tree;
};

}  // namespace

TEST_CASE("half of v M v is the energy of all links", "[sim]") {
  Tree t(GENERATE(false, true));
  t.tree.prepare(Vector3(0, 0, -9.81));
  double energy = 0;
  for (int i = 0; i < t.tree.dofs(); ++i)
    for (int j = 0; j < t.tree.dofs(); ++j)
      energy += 0.5 * t.tree.velocity[static_cast<std::size_t>(i)] * t.tree.mass(i, j) *
                t.tree.velocity[static_cast<std::size_t>(j)];
  CHECK(energy == Approx(t.kinetic_energy()).epsilon(1e-10));
}

TEST_CASE("the inverse mass matrix is one, and is filled up with zeros", "[sim]") {
  Tree t(GENERATE(false, true));
  t.tree.prepare(Vector3::Zero());
  for (int i = 0; i < t.tree.dofs(); ++i) {
    for (int j = 0; j < t.tree.dofs(); ++j) {
      double sum = 0;
      for (int k = 0; k < t.tree.dofs(); ++k) sum += t.tree.mass(i, k) * t.tree.inverse_mass(k)[j];
      CHECK(sum == Approx(i == j ? 1 : 0).margin(1e-10));
    }
    for (int j = t.tree.dofs(); j < t.tree.width(); ++j) CHECK(t.tree.inverse_mass(i)[j] == 0);
  }
}

TEST_CASE("a tree that swings or falls freely keeps its energy", "[sim]") {
  Tree t(GENERATE(false, true));
  const double g = 9.81, start = t.kinetic_energy() + t.potential_energy(g);
  const double dt = 1e-5;
  for (int step = 0; step < 50000; ++step) {
    t.tree.prepare(Vector3(0, 0, -g));
    std::vector<double> acceleration(t.tree.velocity.size(), 0);
    for (int i = 0; i < t.tree.dofs(); ++i)
      for (int j = 0; j < t.tree.dofs(); ++j)
        acceleration[static_cast<std::size_t>(i)] -=
            t.tree.inverse_mass(i)[j] * t.tree.bias()[static_cast<std::size_t>(j)];
    for (std::size_t i = 0; i < acceleration.size(); ++i) t.tree.velocity[i] += dt * acceleration[i];
    t.tree.move(dt);
  }
  CHECK(t.kinetic_energy() > 1);  // it does swing
  CHECK(t.kinetic_energy() + t.potential_energy(g) == Approx(start).margin(0.01));
}

TEST_CASE("a free body that tumbles keeps its angular momentum, and wins no energy", "[sim]") {
  ContactFinder finder;
  btCollisionObject object;
  Dynamics dynamics(finder, Vector3::Zero(), 1.0 / 240);
  const Vector3 moments(1, 2, 3);
  FreeBody& body = dynamics.movers().add_free({&object, 1, moments, Vector3(0.1, 0, 0), Vector3(0.1, 4, 0.1)});
  const auto momentum = [&](double& energy) {
    const Matrix3 turn = from_bullet(object.getWorldTransform()).linear();
    const Vector3 local = turn.transpose() * body.angular;
    energy = 0.5 * local.dot(moments.cwiseProduct(local));
    return Vector3(turn * moments.cwiseProduct(local));
  };
  double before = 0, after = 0;
  const Vector3 start = momentum(before);
  bool flipped = false;  // about the middle axis nothing spins for long (Dzhanibekov)
  for (int i = 0; i < 2400; ++i) {
    dynamics.step(20);
    flipped = flipped || object.getWorldTransform().getBasis()[1][1] < -0.5;
  }
  const Vector3 end = momentum(after);
  CHECK(flipped);
  CHECK((end - start).norm() < 0.05 * start.norm());
  CHECK(after <= before * 1.001);
  CHECK(after > before * 0.8);
  CHECK(object.getWorldTransform().getOrigin().x() == Approx(1.0).epsilon(1e-9));
}
