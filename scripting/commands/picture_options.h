// Options about pictures, which `run` and `render` share.
#pragma once

#include <vector>

#include "engine/record/observation.h"
#include "scripting/program/command.h"

namespace stampede::program {

constexpr int kLargestSide = 4096;  // pixels

enum class PictureUse { run, render };  // noise of torques and channels are a run's alone

// --camera --size --kinds --shadows --noise, --camera-file --add-camera; for `run` --images and --channels too.
std::vector<OptionRow> picture_options(PictureUse use);

// What was given; everything else is left open. Throws UsageError for what makes no sense.
ObservationChoice picture_choice(const Arguments& arguments, PictureUse use);

// The cameras of --camera-file and --add-camera, in this order, as they stand in the scene.
// Throws UsageError, and Error for a calibration file of the wrong shape.
std::vector<Camera> further_cameras(const Arguments& arguments, const Scene& scene);

// Throws UsageError with the nearest name for a camera or sensor that the scene does not have.
void check_choice(const ObservationChoice& choice, const Scene& scene);

// `64x48`. Throws UsageError for what is no size, and for sizes outside 1 … kLargestSide.
std::array<int, 2> size_from(const std::string& option, const std::string& text);

double number_in(const std::string& option, const std::string& text, double least, double most);

}  // namespace stampede::program
