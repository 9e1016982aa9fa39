// Bullet's solver, which also tells what rolling and spinning friction did: contact points leave that out.
#pragma once

#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>

#include <vector>

namespace stampede {

class TorsionSolver final : public btMultiBodyConstraintSolver {
 public:
  struct Torsion {
    const btCollisionObject *on, *other;  // null: not a link
    btVector3 impulse;                    // angular, world, on `on`; the other got the opposite
  };
  void forget_torsions() { torsions_.clear(); }
  const std::vector<Torsion>& torsions() const { return torsions_; }  // of the last step

 protected:
  btScalar solveGroupCacheFriendlyFinish(btCollisionObject** bodies, int count,
                                         const btContactSolverInfo& info) override {
    for (const auto* rows :
         {&m_multiBodyTorsionalFrictionContactConstraints, &m_multiBodySpinningFrictionContactConstraints})
      for (int i = 0; i < rows->size(); ++i) note((*rows)[i]);
    return btMultiBodyConstraintSolver::solveGroupCacheFriendlyFinish(bodies, count, info);
  }

 private:
  static const btCollisionObject* collider(const btMultiBody* multibody, int link) {
    if (multibody == nullptr) return nullptr;
    return link < 0 ? multibody->getBaseCollider() : multibody->getLink(link).m_collider;
  }
  void note(const btMultiBodySolverConstraint& row) {
    const btScalar impulse = row.m_appliedImpulse;
    const btCollisionObject *a = collider(row.m_multiBodyA, row.m_linkA), *b = collider(row.m_multiBodyB, row.m_linkB);
    if (impulse == 0 || (a == nullptr && b == nullptr)) return;
    const btVector3 axis = a != nullptr ? row.m_relpos1CrossNormal : -row.m_relpos2CrossNormal;
    torsions_.push_back({a, b, axis * impulse});
  }
  std::vector<Torsion> torsions_;
};

}  // namespace stampede
