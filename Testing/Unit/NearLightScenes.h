// A sign and a lamp in smoke, for tests of the light near to them.
#pragma once

#include "SceneLibrary.h"

#include <utility>

namespace smokevis::test
{

/// Of the smoke around BarredSign [1/m].
constexpr double SignExtinction = 2.0;

/// A sign of bars, every other lit, 0.5 m x 0.25 m, at the end of a box of even smoke.
inline SceneDescription BarredSign(int bars)
{
  SceneDescription scene;
  scene.Albedo = 0.5;
  scene.Grids = {scenes::UniformSmoke(Vec3(0.0), Vec3(2.0), {12, 12, 12}, SignExtinction)};
  for (int bar = 0; bar < bars; bar += 2)
  {
    const double low = 0.75 + 0.5 * bar / bars;
    const double high = 0.75 + 0.5 * (bar + 1) / bars;
    EmitterCell cell;
    cell.Vertices = {{2, low, 0.9}, {2, low, 1.15}, {2, high, 1.15}, {2, high, 0.9}};
    cell.Luminance = {100, 100, 100};
    cell.SignId = 0;
    scene.Emitters.push_back(cell);
  }
  return scene;
}

/// A lamp of 0.6 m x 1.2 m under z = 3 in even smoke.
inline SceneDescription CeilingLamp(double exponent, double extinction)
{
  SceneDescription scene;
  scene.Albedo = 0.9;
  scene.Grids = {scenes::UniformSmoke(Vec3(0.0), {4, 4, 3}, {16, 16, 16}, extinction)};
  EmitterCell cell;
  cell.Vertices = {{1.7, 1.4, 3}, {1.7, 2.6, 3}, {2.3, 2.6, 3}, {2.3, 1.4, 3}};
  cell.Luminance.fill(1000.0);
  cell.Exponent = exponent;
  scene.Emitters = {cell};
  return scene;
}

} // namespace smokevis::test
