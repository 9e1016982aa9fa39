// What Lua sees of a world (`w`) and of random draws (`rng`).
#pragma once

#include <string>
#include <vector>

#include "engine/base/random.h"
#include "engine/motion/looked.h"
#include "engine/start/world_view.h"
#include "engine/symbolic/symbols.h"
#include "scripting/library/numbers.h"

struct lua_State;

namespace stampede {

// What `w` and `rng` stand for at this moment. One for each Lua state, which it outlives; set for the time of a call
// only: a script that keeps `w` for later gets an error, never another moment's world.
struct ViewContext {
  const WorldView* view = nullptr;
  const CollisionState* space = nullptr;  // while sampling
  int most = 0;                           // samples asked for
  // Where somebody asks: while sampling, places that cannot be; else grasps that keep the arm from what it is asked
  // for.
  std::vector<Looked>* turned_down = nullptr;
  bool asked_arm = false;            // what the arm can do was asked for in this scope
  bool facts = false;                // may the facts be read? Not by predicates: facts are made of these
  std::string hand;                  // `panda.hand`
  const Numbers* numbers = nullptr;  // what is declared of things' numbers
};

// Sets a context for a scope. Scopes nest.
class ViewScope {
 public:
  ViewScope(ViewContext& context, const WorldView& view, const CollisionState* space = nullptr, int most = 0,
            std::vector<Looked>* turned_down = nullptr)
      : context_(context), before_(context) {
    context.view = &view;
    context.space = space;
    context.most = most;
    context.turned_down = turned_down;
    context.asked_arm = false;
    context.facts = false;
  }
  enum class Facts { readable };
  ViewScope(ViewContext& context, const WorldView& view, Facts) : ViewScope(context, view) { context.facts = true; }
  ~ViewScope() {
    context_.view = before_.view;
    context_.space = before_.space;
    context_.most = before_.most;
    context_.turned_down = before_.turned_down;
    context_.asked_arm = before_.asked_arm;
    context_.facts = before_.facts;
  }
  ViewScope(const ViewScope&) = delete;
  ViewScope& operator=(const ViewScope&) = delete;

 private:
  ViewContext& context_;
  struct Before {
    explicit Before(const ViewContext& context)
        : view(context.view),
          space(context.space),
          most(context.most),
          turned_down(context.turned_down),
          asked_arm(context.asked_arm),
          facts(context.facts) {}
    const WorldView* view;
    const CollisionState* space;
    int most;
    std::vector<Looked>* turned_down;
    bool asked_arm, facts;
  } before_;
};

// A world without a world: pushes `w`, one userdata for each state. Objects are named by text. Units: m, rad, s, N.
// README.md lists the methods.
void push_view(lua_State* state, ViewContext& context);

// rng:uniform() rng:between(a, b) rng:integer(a, b) rng:normal() rng:pick(list)
void push_random(lua_State* state, RandomKey key);
Random& check_random(lua_State* state, int index);

}  // namespace stampede
