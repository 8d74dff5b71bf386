// How standards want exit signs to look. Luminances are the least that they allow, so that what is
// found for a preset holds for every sign that meets the standard. The README says where each
// number was read; the standards themselves were not at hand.
#include "SignPlate.h"

#include <algorithm>

namespace smokevis
{
namespace
{

/// Linear red, green and blue of signal colours, pale enough for the materials of real signs.
constexpr double White[3] = {1.0, 1.0, 1.0};
constexpr double Green[3] = {0.0, 1.0, 0.25};
constexpr double Red[3] = {1.0, 0.02, 0.02};

struct Look
{
  SignPattern Pattern;
  SignDesign Design;
  double Luminance, UnlitLuminance;
  double Uniformity;
  const double* Colour;
  const double* UnlitColour;
  double Reflectance, UnlitReflectance;
};

Look LookOf(SignPreset preset)
{
  switch (preset)
  {
  case SignPreset::En1838:
    return {SignPattern::RunningMan, SignDesign::Stencil, 10.0, 2.0, 1.0, White, Green, 0.0, 0.0};
  case SignPreset::En1838Smoke:
    return {SignPattern::RunningMan, SignDesign::Stencil, 50.0, 10.0, 1.0, White, Green, 0.0, 0.0};
  case SignPreset::Iso3864:
    return {SignPattern::RunningMan, SignDesign::Stencil, 0.0, 0.0, 1.0, White, Green, 0.75, 0.12};
  case SignPreset::Ul924Panel:
    return {SignPattern::Text, SignDesign::Panel, 0.41, 0.205, 1.0, White, Red, 0.0, 0.0};
  default:
    return {SignPattern::Text, SignDesign::Stencil, 0.205, 0.0, 1.0, Red, White, 0.0, 0.0};
  }
}

} // namespace

//------------------------------------------------------------------------------
void SignPlate::Apply(SignPreset preset)
{
  if (preset == SignPreset::Custom)
  {
    return;
  }
  const Look look = LookOf(preset);
  this->Pattern = look.Pattern;
  this->Design = look.Design;
  this->Text = "EXIT";
  this->FigureHeight = 0.0;
  this->Luminance = look.Luminance;
  this->UnlitLuminance = look.UnlitLuminance;
  this->Uniformity = look.Uniformity;
  this->EmissionExponent = 0.0;
  std::copy_n(look.Colour, 3, this->Colour);
  std::copy_n(look.UnlitColour, 3, this->UnlitColour);
  this->Reflectance = look.Reflectance;
  this->UnlitReflectance = look.UnlitReflectance;
}

//------------------------------------------------------------------------------
std::string PresetSource(SignPreset preset)
{
  switch (preset)
  {
  case SignPreset::En1838:
    return "EN 1838:2013, 5: any area of the safety colour at least 2 cd/m2, white at least 5 "
           "times that; pictogram in the spirit of ISO 7010, E001";
  case SignPreset::En1838Smoke:
    return "EN 1838 with 10 cd/m2 of the safety colour, as is asked for where smoke can arise, and "
           "white at least 5 times that";
  case SignPreset::Iso3864:
    return "ISO 3864-4: luminance factors of non-luminous materials, white at least 0.75, green at "
           "least 0.12; seen by ambient light alone";
  case SignPreset::Ul924Stencil:
    return "UL 924: letters of at least 0.06 footlambert (0.205 cd/m2) on a dark ground, stroke "
           "1/8 of their height";
  case SignPreset::Ul924Panel:
    return "UL 924: dark letters of 0.06 footlambert (0.205 cd/m2) on a ground twice as bright, "
           "contrast 0.5, stroke 1/8 of their height";
  case SignPreset::Custom:
    break;
  }
  return {};
}

} // namespace smokevis
