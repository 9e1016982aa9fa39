#include "db/recording/resample.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace stampede;

namespace {

Track track_of(std::vector<double> time, std::vector<double> values) {
  Track track;
  track.time = std::move(time), track.values = std::move(values);
  track.columns = {{"q", true}};
  return track;
}

}  // namespace

TEST_CASE("values at frames lie on straight lines between readings, and not across gaps") {
  const Track track = track_of({0, 0.04, 0.08, 0.4, 0.44}, {0, 4, 8, 40, 44});
  const FrameTimes frames{0, 50, 23};  // every 0.02 s
  const std::vector<double> values = linear(track, frames, 0.1);
  CHECK(values[0] == 0);
  CHECK(values[1] == Approx(2));
  CHECK(values[4] == Approx(8));  // a reading of its own
  for (std::size_t i = 5; i < 20; ++i) CHECK(std::isnan(values[i]));
  CHECK(values[20] == 40);
  CHECK(values[21] == Approx(42));
  CHECK(gap_bound(track) == Approx(0.12));  // three periods of 25 Hz
}

TEST_CASE("a command holds until the next one, and is forgotten after the bound") {
  const Track track = track_of({0.01, 0.06, 0.3}, {1, 2, 3});
  const std::vector<double> values = held(track, {0, 20, 8}, 0.1);  // frames at 0, 0.05 … 0.35
  CHECK(values[0] == 1);
  CHECK(values[1] == 2);  // it came before the next frame
  CHECK(values[3] == 2);
  CHECK(std::isnan(values[4]));
  CHECK(values[6] == 3);
}

TEST_CASE("each frame takes the nearest picture within half a period, and none is taken twice") {
  const std::vector<std::int64_t> chosen = nearest({-0.1, 0.003, 0.051, 0.074, 0.16, 0.2, 0.9}, {0, 20, 5});
  CHECK(chosen == std::vector<std::int64_t>{1, 2, -1, 4, 5});  // 0.074 is nearer to 0.05, which has a nearer one
}

TEST_CASE("rates are differences of both neighbours, and of one at ends and gaps") {
  const double gap = std::nan("");
  const std::vector<double> rates = differences({0, 1, 4, gap, 7, 8}, 1, 10);
  CHECK(rates[0] == Approx(10));
  CHECK(rates[1] == Approx(20));
  CHECK(rates[2] == Approx(30));
  CHECK(std::isnan(rates[3]));
  CHECK(rates[4] == Approx(10));
}

TEST_CASE("rates of several columns are each column's own") {
  const std::vector<double> rates = differences({0, 100, 1, 300, 4, 600}, 2, 10);
  CHECK(rates == std::vector<double>{10, 2000, 20, 2500, 30, 3000});
}

TEST_CASE("frames before the first reading and after the last have no value on a line") {
  const std::vector<double> values = linear(track_of({0.03, 0.05, 0.07}, {3, 5, 7}), {0, 50, 6}, 0.1);
  CHECK(std::isnan(values[0]));
  CHECK(std::isnan(values[1]));
  CHECK(values[2] == Approx(4));
  CHECK(values[3] == Approx(6));
  CHECK(std::isnan(values[4]));
  CHECK(std::isnan(values[5]));
}

TEST_CASE("of a stream the readings within the episode are counted, with their rate and longest gap") {
  StreamRecord stream;
  describe_times({-1, 0, 0.1, 0.2, 0.3, 0.8, 0.9, 5}, 0, 1, stream);
  CHECK(stream.readings == 6);
  CHECK(stream.rate_hz == Approx(10));
  CHECK(stream.longest_gap_s == Approx(0.5));
  describe_times({-1, 5}, 0, 1, stream);
  CHECK(stream.readings == 0);
  CHECK(stream.rate_hz == 0);
  CHECK(stream.longest_gap_s == 0);
}

TEST_CASE("a clock has an offset, and a drift that counts from its reference") {
  const RecordingClock clock{"arm", 0.25, 100, 1.7e9};
  CHECK(clock.time(1.7e9) == Approx(1.7e9 + 0.25).margin(1e-6));
  CHECK(clock.time(1.7e9 + 1000) - clock.time(1.7e9) == Approx(1000.1).margin(1e-6));
}
