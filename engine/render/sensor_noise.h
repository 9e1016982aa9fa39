// What real cameras add. A function of (key, pixel): the same picture alone or among others.
#pragma once

#include "engine/base/random.h"
#include "engine/render/picture.h"

namespace stampede {

struct CameraNoise {
  double rgb = 0;  // standard deviation of each channel, of 0 … 1; clipped
  // An RGB-D sensor (Khoshelham, Elberink, Sensors 2012, doi:10.3390/s120201437): deviation depth * z^2 (1/m), depth
  // quantised accordingly, and no reading at silhouettes and grazing angles. 0: none; 0.00145 is a Kinect's.
  double depth = 0;
  bool any() const { return rgb > 0 || depth > 0; }
};

// Kinds that the picture does not have are left out. `key` tells episode, camera and frame apart; the kinds are told
// apart here.
void add_noise(Picture& picture, const Camera& camera, const CameraNoise& noise, RandomKey key);

}  // namespace stampede
