// The benchmark's command line: SmokeBenchmark --case tunnel,hall12 --tolerance 0.1,0.01 ...
#include "BenchmarkCases.h"

#include <cstdio>
#include <exception>
#include <map>
#include <sstream>
#include <stdexcept>

namespace
{

using namespace smokevis::benchmark;

struct Case
{
  std::function<void(const Settings&)> Run;
  /// What it does unless the command line asks for something else.
  Settings Usual;
};

const std::map<std::string, Case> Cases = {
  {"tunnel",
    {RunTunnel, {.Tolerances = {0.1, 0.03, 0.02, 0.01, 0.003}, .ReferenceTolerance = 0.001}}},
  {"hall12",
    {[](const Settings& settings)
      { RunMap(settings, "hall12", Hall(settings.Time), HallPlaces(12, 8, settings.Threads)); },
      {.Samples = {1, 4, 16, 64, 256}}}},
  // Finer references than this would take half an hour.
  {"fire12", {[](const Settings& settings) {
                RunMap(settings, "fire12", BurningHall(settings.Time),
                  HallPlaces(12, 8, settings.Threads));
              },
               {.Tolerances = {0.1, 0.03, 0.01},
                 .Samples = {1, 4, 16},
                 .ReferenceTolerance = 0.005,
                 .Seeds = 1}}},
  {"hall110",
    {[](const Settings& settings)
      { RunMap(settings, "hall110", Hall(settings.Time), HallPlaces(110, 70, settings.Threads)); },
      {.Samples = {1, 4, 16}, .Seeds = 2}}},
  // Ten million cells say enough of themselves; a finer reference would take hours.
  {"hall10m", {[](const Settings& settings) {
                 RunMap(settings, "hall10m", FineHall(settings.Time),
                   HallPlaces(12, 8, settings.Threads));
               },
                {.ReferenceTolerance = 0.004, .Seeds = 1}}},
  {"office", {[](const Settings& settings)
               { RunMap(settings, "office", Office(), OfficePlaces(settings.Threads)); },
               {.Samples = {1, 4, 16}, .Seeds = 2}}},
  {"growth", {RunGrowth, {}}},
  {"threads", {RunThreads, {}}},
  {"steps", {RunSteps, {}}},
  {"skips", {RunSkips, {}}},
  {"thick", {RunThick, {.Tolerances = {0.1, 0.03}, .ReferenceTolerance = 0.01}}},
};

std::vector<std::string> SplitList(const std::string& list)
{
  std::vector<std::string> items;
  std::istringstream stream(list);
  for (std::string item; std::getline(stream, item, ',');)
  {
    items.push_back(item);
  }
  return items;
}

std::vector<double> Numbers(const std::string& list)
{
  std::vector<double> numbers;
  for (const std::string& item : SplitList(list))
  {
    numbers.push_back(std::stod(item));
  }
  return numbers;
}

/// What the command line asks for, over what is usual.
Settings Parse(int count, char** words, Settings settings)
{
  const std::map<std::string, std::function<void(const std::string&)>> options = {
    {"--case", [&](const std::string& word) { settings.Cases = SplitList(word); }},
    {"--tolerance", [&](const std::string& word) { settings.Tolerances = Numbers(word); }},
    {"--samples", [&](const std::string& word) { settings.Samples = Numbers(word); }},
    {"--threads", [&](const std::string& word) { settings.Threads = std::stoi(word); }},
    {"--reference-tolerance",
      [&](const std::string& word) { settings.ReferenceTolerance = std::stod(word); }},
    {"--seeds", [&](const std::string& word) { settings.Seeds = std::stoi(word); }},
    {"--limit", [&](const std::string& word) { settings.Limit = std::stod(word); }},
    {"--time", [&](const std::string& word) { settings.Time = std::stod(word); }},
    {"--out", [&](const std::string& word) { settings.Out = word; }},
  };
  for (int i = 1; i < count; i += 2)
  {
    const auto option = options.find(words[i]);
    if (option == options.end() || i + 1 >= count)
    {
      throw std::invalid_argument(std::string("unknown or incomplete option ") + words[i]);
    }
    option->second(words[i + 1]);
  }
  if (settings.Seeds < 1)
  {
    throw std::invalid_argument("--seeds must be 1 or more");
  }
  if (settings.Cases.empty())
  {
    throw std::invalid_argument("no case is asked for");
  }
  return settings;
}

void PrintUsage()
{
  std::fprintf(stderr,
    "SmokeBenchmark --case A,B,... [options]\n"
    "  cases: tunnel hall12 fire12 hall110 hall10m office growth threads steps skips thick\n"
    "  --tolerance 0.1,0.03,0.01,0.003   tolerances of the solver (tunnel, maps)\n"
    "  --samples 1,4,16,64               samples a pixel, or a point of a sign, of the reference\n"
    "                                    integrator (tunnel, maps); empty: without it\n"
    "  --reference-tolerance 0.002       of what errors are measured against; 0: no errors "
    "(maps)\n"
    "  --seeds 4                         solutions of a tolerance (tunnel, maps)\n"
    "  --threads 0                       of the solver; 0: all\n"
    "  --limit 60                        a growth curve ends after so many processor seconds\n"
    "  --time 600                        second of the hall's fire\n"
    "  --out .                           folder for the CSV files\n"
    "What is not given is as suits each case.\n");
}

} // namespace

int main(int count, char** words)
{
  Settings settings;
  try
  {
    settings = Parse(count, words, {});
    for (const std::string& name : settings.Cases)
    {
      if (Cases.find(name) == Cases.end())
      {
        throw std::invalid_argument("unknown case " + name);
      }
    }
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "%s\n", error.what());
    PrintUsage();
    return 2;
  }
  try
  {
    for (const std::string& name : settings.Cases)
    {
      std::printf("== %s\n", name.c_str());
      const Case& chosen = Cases.at(name);
      chosen.Run(Parse(count, words, chosen.Usual));
    }
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
