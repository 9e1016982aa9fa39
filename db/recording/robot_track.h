// The robot's streams as frames: its joints, hand, cameras and what it was told to do.
#pragma once

#include "db/recording/resample.h"
#include "engine/base/hash.h"
#include "engine/model/scene.h"
#include "engine/record/record.h"

namespace stampede {

// Columns of a joints or command stream for this robot.
std::vector<TrackColumn> joint_columns(const Robot& robot);
std::vector<TrackColumn> command_columns(const Robot& robot);

// Throws Error, with the line, where an arm's position lies beyond its limits: it is another robot's, or in degrees.
void check_joint_limits(const RecordingFile& recording, const RecordedStream& stream, const Track& track,
                        const Robot& robot);
void check_openings(const RecordingFile& recording, const RecordedStream& stream, const Track& track,
                    const Robot& robot);

// What is known of the robot at frames. Tracks may be null.
struct RobotTracks {
  const Track* joints = nullptr;
  const Track* gripper = nullptr;
  const Track* command = nullptr;
};

// Fills record.scene.joints, hands and frames: positions, rates and efforts at the frames' times; the tool's pose and
// twist by the URDF's kinematics; poses of the cameras; actions. Without recorded velocities they are differences of
// positions, without a command stream an action is the state of the next frame; record.made.options say which
// (`velocities`, `actions`).
void fill_frames(const Scene& scene, const RobotTracks& tracks, const FrameTimes& times, EpisodeRecord& record);

}  // namespace stampede
