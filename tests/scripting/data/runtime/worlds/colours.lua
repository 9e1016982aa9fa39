-- Four colours, told apart by their numbers.
return {
  red = { 1.0, 0.0, 0.0 },
  green = { 0.0, 1.0, 0.0 },
  blue = { 0.0, 0.0, 1.0 },
  white = { 1.0, 1.0, 1.0 },
}
