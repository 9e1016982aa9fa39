// A tree of links on joints in reduced coordinates, one number a joint. Its base stands still, or floats: then the
// first link is a free body that carries the others, and moves in six numbers more.
#pragma once

#include <vector>

#include "engine/model/scene.h"

class btCollisionObject;

namespace stampede {

// A rotation after `dt` s of turning with `spin` (rad/s, world axes); an eighth of a turn at most.
Matrix3 turned_by(const Matrix3& rotation, const Vector3& spin, double dt);

class Articulation {
 public:
  struct Link {
    int parent = -1;  // a link before this one; -1: the base
    JointKind kind = JointKind::fixed;
    Transform parent_from_joint = Transform::Identity();  // from the parent's frame, the base's where there is none
    Vector3 axis = Vector3::UnitZ();                      // unit, in the joint's frame
    double lead = 0;                                      // of a screw, m/rad
    double mass = 0;
    Vector3 centre = Vector3::Zero();     // of mass, in the link's frame
    Matrix3 inertia = Matrix3::Zero();    // about the centre, in the link's axes
    btCollisionObject* object = nullptr;  // is moved along
    Transform link_from_object = Transform::Identity();
  };

  Articulation(const Transform& world_from_base, bool floating)
      : world_from_base_(world_from_base), floating_(floating) {}
  int add(const Link& link);                                                       // its index
  int dof(int link) const { return places_[static_cast<std::size_t>(link)].dof; }  // -1: a fixed joint
  bool floating() const { return floating_; }
  int dofs() const { return static_cast<int>(position.size()); }
  int width() const { return (dofs() + 3) / 4 * 4; }  // of arrays that are read four numbers at a time

  // By dof: m or rad, and their rates. Whoever sets positions calls `place` before anything else. The first six of a
  // floating tree: no positions; the speeds of the first link's origin and its spin, in world axes.
  std::vector<double> position, velocity;
  std::vector<double> torque;  // N or N m, given from outside for the next step

  // The first link of a floating tree; `place` is called by these.
  const Transform& world_from_root() const { return world_from_base_; }
  void set_root(const Transform& world_from_root);
  void move(double dt);  // at the speeds that it has

  // Forward kinematics: where the links are, and their objects.
  void place();
  // Inertia and bias forces where the links are and at their speeds: composite rigid bodies and recursive Newton-Euler
  // (Featherstone, Rigid Body Dynamics Algorithms, 2008, chapters 5 and 6, doi:10.1007/978-1-4899-7560-7), all vectors
  // in world axes.
  void prepare(const Vector3& gravity);
  // By dof, the part of `bias` that comes of the speeds: centrifugal and Coriolis forces. Overwrites `bias`.
  const std::vector<double>& find_coriolis();
  // By dof, of the last `prepare`. `bias`: the torques that would keep every joint at its speed. The inverse of the
  // mass matrix is symmetric, its rows are width() apart and filled up with zeros.
  const std::vector<double>& bias() const { return bias_; }
  const double* inverse_mass(int dof) const { return &inverse_[static_cast<std::size_t>(dof * width())]; }
  double mass(int row, int column) const { return mass_[static_cast<std::size_t>(row * dofs() + column)]; }

  // How a point of a link moves, and how the link turns, at unit speed of each dof: calls visit(dof, linear, angular)
  // for the dofs that the link hangs on, from the link to the base. World axes.
  template <typename Visit>
  void jacobian(int link, const Vector3& point, Visit visit) const {
    for (int at = link; at >= 0; at = links_[static_cast<std::size_t>(at)].parent) {
      const Place& here = places_[static_cast<std::size_t>(at)];
      for (int dof = here.dof; dof < here.dof + here.dofs; ++dof) {
        const Twist& twist = twists_[static_cast<std::size_t>(dof)];
        visit(dof, Vector3(twist.linear + twist.angular.cross(point - here.origin)), twist.angular);
      }
    }
  }

 private:
  struct Place {  // of a link in the world
    int dof = -1, dofs = 0;
    Matrix3 turn = Matrix3::Identity();
    Vector3 origin = Vector3::Zero(), centre = Vector3::Zero();
  };
  struct Twist {  // what a dof at unit speed does to its link: the speed of the link's origin, and its spin
    Vector3 linear = Vector3::Zero(), angular = Vector3::Zero();
  };
  struct Motion {  // of a link: speed and acceleration of its origin, and what it pulls its parent with
    Vector3 linear, angular, linear_rate, angular_rate, force, moment;
  };
  struct Composite {  // of a link and all beyond it: mass, first and second moment about the base's origin
    double mass;
    Vector3 moment;
    Matrix3 inertia;
  };
  void find_bias(const Vector3& gravity);
  void find_mass();
  void invert_mass();

  Transform world_from_base_;
  bool floating_;
  std::vector<Link> links_;
  std::vector<Place> places_;
  std::vector<Twist> twists_;
  std::vector<Motion> motions_;
  std::vector<Composite> composites_;
  std::vector<Matrix3> inertias_;  // about the centre, world axes
  std::vector<double> bias_, mass_, inverse_, factor_;
};

}  // namespace stampede
