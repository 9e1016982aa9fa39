#include "db/research/frame_answers.h"

#include "engine/base/error.h"

namespace stampede::research {

std::string name_of(std::int64_t episode, std::int64_t frame, const std::string& about) {
  return "frame " + std::to_string(frame) + " of episode " + std::to_string(episode) +
         (about.empty() ? "" : ", " + about);
}

Places places_of(const ScoringJob& job, const std::string& column) {
  Places places;
  const Rows& rows = job.answers.rows;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!column.empty() && rows.is_null(i, column)) continue;
    const Place place = {rows.integer(i, "episode"), rows.integer(i, "frame"),
                         column.empty() ? "" : rows.text(i, column)};
    if (!places.emplace(place, i).second)
      throw Error(job.answers.where + ", answer " + std::to_string(i + 1),
                  name_of(std::get<0>(place), std::get<1>(place), std::get<2>(place)) + " is answered twice");
  }
  return places;
}

std::size_t row_about(const ScoringJob& job, const Places& places, const Place& place) {
  const auto found = places.find(place);
  if (found != places.end()) return found->second;
  throw Error(job.answers.where,
              "there is no answer for " + name_of(std::get<0>(place), std::get<1>(place), std::get<2>(place)),
              "the given part's page says which frames are asked about");
}

void refuse_missing(const ScoringJob& job, const std::vector<std::string>& missing, std::size_t asked,
                    const std::string& what, const std::string& cure) {
  if (missing.empty()) return;
  throw Error(job.answers.where,
              "there is no answer for " + std::to_string(missing.size()) + " of " + std::to_string(asked) + " " + what +
                  ", the first: " + missing.front(),
              cure);
}

void refuse_beyond_the_end(const ScoringJob& job) {
  std::map<std::int64_t, std::int64_t> frames;
  const Rows episodes = job.hidden.query("SELECT episode, frames FROM episodes");
  for (std::size_t i = 0; i < episodes.size(); ++i)
    frames[episodes.integer(i, "episode")] = episodes.integer(i, "frames");
  for (std::size_t i = 0; i < job.answers.rows.size(); ++i) {
    const std::int64_t episode = job.answers.rows.integer(i, "episode"), frame = job.answers.rows.integer(i, "frame");
    if (frame < 0 || frame >= frames.at(episode))
      throw Error(job.answers.where + ", answer " + std::to_string(i + 1), name_of(episode, frame) + " is not there",
                  "it has frames 0 to " + std::to_string(frames.at(episode) - 1));
  }
}

}  // namespace stampede::research
