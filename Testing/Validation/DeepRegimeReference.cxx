// Makes Data/References/deep_tunnel_own.csv: the luminance of the tunnel's dark bars by the
// reference integrator. Usage: DeepRegimeReference MILLIONS_OF_SAMPLES [NAME] > deep_tunnel_own.csv
// With a name, of that scene alone.
#include "DeepScenes.h"

#include <cstdio>
#include <cstdlib>

int main(int count, char** words)
{
  using namespace smokevis;
  if (count < 2 || count > 3 || std::atof(words[1]) <= 0.0)
  {
    std::fprintf(stderr, "usage: %s MILLIONS_OF_SAMPLES [NAME]\n", words[0]);
    return 2;
  }
  const auto samples = static_cast<std::uint64_t>(1e6 * std::atof(words[1]));
  std::printf(
    "# Mean luminance of the dark bars of the tunnel's sign (luminance 1 cd/m2 of the lit "
    "bars) and its standard\n# error, by the path tracer of "
    "Testing/Validation/ReferenceIntegrator, %s million samples a row.\n"
    "# Made with: build/release/bin/DeepRegimeReference %s\n"
    "name,extinction,albedo,dark,dark_error\n",
    words[1], words[1]);
  for (const scenes::DeepScene& deep : scenes::DeepScenes)
  {
    if (count == 3 && deep.Name != words[2])
    {
      continue;
    }
    const Scene scene(scenes::Tunnel(deep.Extinction, deep.Albedo));
    const Estimate dark = ReferenceIntegrator(scene).MeanRadiance(
      [](Pcg32& random) { return scenes::TunnelBarRay(false, random); }, samples, 7);
    std::printf("%s,%g,%g,%.6e,%.2e\n", deep.Name.c_str(), deep.Extinction, deep.Albedo, dark.Mean,
      dark.StandardError);
    std::fflush(stdout);
  }
  return 0;
}
