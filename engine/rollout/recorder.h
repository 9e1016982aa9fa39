// Turns a running world into frames, segments and contacts.
#pragma once

#include <map>
#include <optional>
#include <tuple>

#include "engine/base/shared_list.h"
#include "engine/record/record.h"
#include "engine/start/world_view.h"

namespace stampede {

// What a frame observes; the runner records with it and the replayer compares with it.
class FrameReader {
 public:
  explicit FrameReader(const WorldView& view);
  FrameReader(const WorldView& view, std::vector<JointName> joints);  // of these alone
  FrameRecord read(const WorldView& view) const;                      // without action, reward and done
  ActionRecord action(const World& world) const;                      // the reference as it is now
  const std::vector<JointName>& joints() const { return joints_; }
  const std::vector<std::string>& posed() const { return posed_; }

 private:
  std::vector<JointName> joints_;
  std::vector<std::string> posed_;
};

// Where a checkpoint cuts the record off again. Copies share what was recorded before them.
class Recorder {
 public:
  explicit Recorder(const WorldView& view);

  void first_frame(const WorldView& view);           // at step 0
  void frame(const WorldView& view, double reward);  // closes the interval since the last frame
  void contacts(const WorldView& view);              // of the window just closed

  int open_segment(SegmentRecord segment, std::int64_t step);  // its ordinal
  void close_segment(int ordinal, std::int64_t step, Reason reason, std::string detail);
  SegmentRecord& segment(int ordinal) { return segments.edit(static_cast<std::size_t>(ordinal)); }
  std::int64_t frame_at(std::int64_t step) const { return (step + steps_per_frame_ - 1) / steps_per_frame_; }

  struct Mark {
    std::size_t frames, segments, vias, grasps, contacts_closed, agent_actions;
    std::map<std::pair<std::string, std::string>, ContactRecord> contacts_open;
  };
  // The last one that was asked for by a skill's policy, or with -1 by who drives the episode; null: there is none.
  AskedAction* last_asked(std::int64_t segment);
  void end_asked(std::int64_t segment, std::int64_t step);  // that one ends here
  void refuse_asked(std::int64_t segment);                  // that one was not done

  Mark mark() const;
  void cut(const Mark& mark);  // everything after the mark never happened
  // All frames but the last, and of contacts, vias, grasps and attempts what is over. Segments from `first_segment` on
  // go too; none of them may be open.
  void forget_frames();
  void forget_segments(std::size_t first_segment);
  void finish(EpisodeRecord& episode, std::int64_t end_step);  // moves all into the episode

  SharedList<FrameRecord> frames;
  SharedList<SegmentRecord, 4> segments;
  SharedList<AttemptRecord, 4> attempts;  // never cut
  SharedList<ViaRecord> vias;
  SharedList<GraspRecord> grasps;
  SharedList<AskedAction> agent_actions;

 private:
  std::optional<std::size_t> place_of_last(std::int64_t segment) const;  // of agent_actions

  FrameReader reader_;
  int steps_per_frame_;
  SharedList<ContactRecord> contacts_closed_;
  std::map<std::pair<std::string, std::string>, ContactRecord> contacts_open_;
};

}  // namespace stampede
