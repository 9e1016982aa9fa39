// A tree of links on joints that hangs on a base that stands still, in reduced coordinates: one number a joint.
#pragma once

#include <vector>

#include "engine/model/scene.h"

class btCollisionObject;

namespace stampede {

class Articulation {
 public:
  struct Link {
    int parent = -1;  // a link before this one; -1: the base
    JointKind kind = JointKind::fixed;
    Transform parent_from_joint = Transform::Identity();  // from the parent's frame, the base's where there is none
    Vector3 axis = Vector3::UnitZ();                      // unit, in the joint's frame
    double mass = 0;
    Vector3 centre = Vector3::Zero();     // of mass, in the link's frame
    Matrix3 inertia = Matrix3::Zero();    // about the centre, in the link's axes
    btCollisionObject* object = nullptr;  // is moved along
    Transform link_from_object = Transform::Identity();
  };

  explicit Articulation(const Transform& world_from_base) : world_from_base_(world_from_base) {}
  int add(const Link& link);                                                       // its index
  int dof(int link) const { return places_[static_cast<std::size_t>(link)].dof; }  // -1: a fixed joint
  int dofs() const { return static_cast<int>(position.size()); }
  int width() const { return (dofs() + 3) / 4 * 4; }  // of arrays that are read four numbers at a time

  // By dof: m or rad, and their rates. Whoever sets positions calls `place` before anything else.
  std::vector<double> position, velocity;
  std::vector<double> torque;  // N or N m, given from outside for the next step

  // Forward kinematics: where the links are, and their objects.
  void place();
  // Inertia and bias forces where the links are and at their speeds: composite rigid bodies and recursive Newton-Euler
  // (Featherstone, Rigid Body Dynamics Algorithms, 2008, chapters 5 and 6, doi:10.1007/978-1-4899-7560-7), all vectors
  // in world axes.
  void prepare(const Vector3& gravity);
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
      if (here.dof < 0) continue;
      if (links_[static_cast<std::size_t>(at)].kind == JointKind::hinge)
        visit(here.dof, Vector3(here.axis.cross(point - here.origin)), here.axis);
      else
        visit(here.dof, here.axis, Vector3(Vector3::Zero()));
    }
  }

 private:
  struct Place {  // of a link in the world
    int dof = -1;
    Matrix3 turn = Matrix3::Identity();
    Vector3 origin = Vector3::Zero(), axis = Vector3::UnitZ(), centre = Vector3::Zero();
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
  std::vector<Link> links_;
  std::vector<Place> places_;
  std::vector<Motion> motions_;
  std::vector<Composite> composites_;
  std::vector<Matrix3> inertias_;  // about the centre, world axes
  std::vector<double> bias_, mass_, inverse_, factor_;
};

}  // namespace stampede
