#include "scripting/session/policy_run.h"

#include <unistd.h>

#include <bit>
#include <fstream>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/file_name.h"
#include "engine/record/observation.h"
#include "scripting/runtime/script_error.h"
#include "scripting/session/policy_json.h"
#include "scripting/session/prepared_source.h"

namespace stampede {
namespace {

static_assert(std::endian::native == std::endian::little);  // files of pictures are little-endian

constexpr int kMostRefusals = 100, kMostIdle = 1000;  // in a row, without a frame going by
constexpr const char* kMemory = "/dev/shm";           // files that need no disk

constexpr const char* kSomeAction = R"({"space":"joint_delta","values":[…]} or {"end":true})";

std::string bytes_of(const ChannelValue& picture) {
  return std::visit(
      [](const auto& data) -> std::string {
        if constexpr (std::is_arithmetic_v<typename std::remove_cvref_t<decltype(data)>::value_type>)
          return {reinterpret_cast<const char*>(data.data()), data.size() * sizeof(data[0])};
        else
          return {};
      },
      picture.data);
}

std::string last_word(const StepResult& result) {
  if (result.refusal)
    return result.refusal->what + (result.refusal->cure.empty() ? "" : " (" + result.refusal->cure + ")");
  if (result.ended.empty()) return "no action moved anything";
  const SkillEnd& end = result.ended.back();
  return end.skill + " ended with " + end.reason + (end.detail.empty() ? "" : ": " + end.detail);
}

}  // namespace

PolicyRun::PolicyRun(PolicySettings settings, const std::atomic<bool>* stop)
    : settings_(std::move(settings)), stop_(stop) {
  settings_.environment.record = true;
}

PolicyRun::~PolicyRun() = default;

EpisodeRecord PolicyRun::act(PreparedEpisode& prepared) {
  if (!program_) program_ = std::make_unique<PolicyProgram>(settings_.command, settings_.patience, stop_);
  const auto source = std::make_shared<PreparedSource>(prepared, settings_.command);
  told_start_ = false;
  try {
    Environment world = make_environment(source, settings_.environment);
    if (!converse(prepared, world)) {
      EpisodeRecord nothing;
      nothing.reason = Reason::interrupted;
      return nothing;
    }
    world.episode();
    EpisodeRecord record = source->take();
    if (chosen(observation_of(record)).images != WhichFrames::none)
      paint_episode(*prepared.options().services.renderer, record, prepared.options().services.encoders);
    return record;
  } catch (const NoStart& error) {
    return source->failed(error.reason(), error.detail());
  } catch (const ScriptError& error) {
    StepResult last;
    last.truncated = true;
    last.reason = to_string(Reason::script_error);
    last.detail = error.what();
    if (told_start_) program_->tell(step_line(last, {}));
    return source->failed(Reason::script_error, error.what());
  }
}

// False: interrupted.
bool PolicyRun::converse(PreparedEpisode& prepared, Environment& world) {
  const EpisodeJob& job = prepared.job();
  const PictureStore pictures = [this](const ChannelValue& picture) { return put_picture(picture); };
  const EnvironmentObservation seen = world.reset({.variation = job.variation, .seed = job.seed});
  std::string line = reset_line({job.task, job.variation, job.seed, instructions_of(prepared)}, world, seen, pictures);
  std::string awaited = "the first action of " + job.task + " seed " + std::to_string(job.seed);
  refusals_ = idle_ = 0;
  told_start_ = true;
  while (true) {
    const std::optional<std::string> answer = program_->ask(line, awaited);
    if (!answer) return false;
    const std::optional<AgentAction> action = understood(*answer, awaited);
    if (!action) return true;
    const StepResult result = world.step(*action);
    if (stopped()) return false;
    line = step_line(result, pictures);
    if (result.terminated || result.truncated) {
      program_->tell(line);
      return true;
    }
    look_at_patience(result);
    awaited = "the next action at frame " + std::to_string(result.observation.frame);
  }
}

std::optional<AgentAction> PolicyRun::understood(const std::string& line, const std::string& awaited) const {
  try {
    return action_from_line(line);
  } catch (const Error& error) {
    program_->fail(
        "line " + std::to_string(program_->answers()) + " of the program, " + shown_line(line) + ": " + error.message(),
        awaited + " is awaited: " + (error.hint().empty() ? kSomeAction : error.hint()));
  }
}

// A program that gets nowhere would act for ever.
void PolicyRun::look_at_patience(const StepResult& result) {
  refusals_ = result.frames > 0 ? 0 : refusals_ + (result.refusal ? 1 : 0);
  idle_ = result.frames > 0 ? 0 : idle_ + 1;
  if (refusals_ >= kMostRefusals)
    program_->fail(std::to_string(refusals_) + " actions in a row were refused, the last because " + last_word(result),
                   "look at `refusal` in each step, and act otherwise or end the episode: {\"end\":true}");
  if (idle_ >= kMostIdle)
    program_->fail("not a frame went by in " + std::to_string(idle_) + " steps; the last: " + last_word(result),
                   "look at `frames` and `ended` in each step, and act otherwise or end the episode: {\"end\":true}");
}

std::string PolicyRun::put_picture(const ChannelValue& picture) {
  if (!pictures_ && access(kMemory, W_OK | X_OK) == 0) pictures_.emplace(kMemory);
  if (!pictures_) pictures_.emplace();
  const std::filesystem::path path = pictures_->path() / (file_name(picture.name) + ".raw");
  const std::string bytes = bytes_of(picture);
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!file.flush())
    throw Error(path, "the picture cannot be written", "make room there, or ask for smaller pictures: --size 128x128");
  return path;
}

}  // namespace stampede
