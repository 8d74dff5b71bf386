// A progress bar that must not fall back.
#pragma once

#include "Progress.h"

#include <gtest/gtest.h>

namespace smokevis
{

class RisingProgress : public Progress
{
public:
  void Report(double fraction) override
  {
    EXPECT_GE(fraction, this->Reached_);
    EXPECT_LE(fraction, 1.0);
    this->Reached_ = fraction;
  }

private:
  double Reached_ = 0.0;
};

} // namespace smokevis
