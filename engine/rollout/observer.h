// What an agent observes, channel by channel, of a world that is being run.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "engine/record/arrays.h"
#include "engine/record/atom_formula.h"
#include "engine/render/renderer.h"
#include "engine/rollout/rollout.h"
#include "stampede/environment.h"

namespace stampede {

// Lifetime: refers to the rollout and the settings; pictures are drawn by the thread that asks first.
class Observer {
 public:
  // `episode`: task, variation and seed, for the noise of pictures. `renderer`: made when the first picture is drawn.
  Observer(Rollout& rollout, std::shared_ptr<const Scene> scene, const RunOptions& options,
           const EnvironmentSettings& settings, const EpisodeRecord& episode, std::unique_ptr<Renderer>& renderer);
  ~Observer();

  // Throws Error for a channel that there is not, with the nearest name as cure.
  void choose(const std::vector<std::string>& channels);
  EnvironmentObservation observe();  // at a frame
  // Colours alone, without noise; `size` 0: as the camera's channels.
  ChannelValue picture(const std::string& camera, PictureSize size);

  const std::vector<Fact>& atoms() const { return atoms_; }  // basic ones, then derived ones
  const std::vector<PlanStep>& skills() const { return skills_; }
  const std::vector<std::uint8_t>& feasible();      // of each skill, now
  const Facts& facts();                             // that the agent may know of
  Facts last_facts() { return std::move(facts_); }  // as they were when they were last asked for

  // After the world was put back: nothing that was seen so far counts.
  void forget();

 private:
  EpisodeArrays columns(const ArrayRequest& request) const;  // of the present
  void enumerate_atoms();
  void enumerate_skills();
  const std::vector<std::uint8_t>& row();  // of atoms that hold, as far as the agent may know
  void add_raw(EnvironmentObservation& observation);
  void add_pictures(EnvironmentObservation& observation);
  void look(const std::vector<std::string>& cameras);  // for the channels
  std::vector<Picture> draw(const std::vector<View>& views, const ScenePoses& poses, const PictureKinds& kinds);
  SceneState state() const;  // of the one frame, with the facts of the present
  View view_from(const std::string& camera, const ScenePoses& poses) const;
  ChannelValue abstract(const std::string& name);
  void hide(ChannelValue& value) const;
  bool names_hidden(const std::string& atom) const;
  AtomFormula compiled(const Formula& formula) const;
  double progress();
  const std::vector<double>& goal();
  std::vector<std::string> plan();

  Rollout& rollout_;
  const RunOptions& options_;
  const EnvironmentSettings& settings_;
  std::unique_ptr<EpisodeRecord> now_;  // its one frame is the present
  std::vector<std::string> raw_, abstract_;
  struct PictureChannel {
    std::string name, camera;
    enum class Kind { rgb, depth, instance, semantic, points } kind;
  };
  std::vector<PictureChannel> pictures_;
  struct Drawn {
    std::int64_t frame = -1;
    Picture picture;
    View view;
  };
  std::map<std::string, Drawn> drawn_;
  std::map<std::string, PictureKinds> kinds_;  // by camera
  std::shared_ptr<const Scene> scene_;
  ShownFacts facts_that_show_;
  std::unique_ptr<Renderer>& renderer_;
  bool loaded_ = false;  // this scene, into the renderer
  std::vector<Fact> atoms_;
  AtomPlaces places_;
  std::vector<PlanStep> skills_;
  // To ask for all things of a kind is most of the work: such parts are compiled when the others hold the first time.
  struct Precondition {
    AtomFormula plain;
    std::optional<AtomFormula> quantified;
  };
  std::vector<Precondition> preconditions_;  // of skills_, once asked for
  std::optional<AtomFormula> goal_;
  std::vector<double> wanted_;  // of the stage wanted_at_
  std::vector<std::uint8_t> row_, feasible_;
  Facts facts_;
  std::int64_t facts_at_ = -1, row_at_ = -1, feasible_at_ = -1, plan_at_ = -1, wanted_at_ = -1;
  std::vector<std::string> plan_;
  std::set<std::string> hidden_;
};

}  // namespace stampede
