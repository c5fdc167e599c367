// The flip thresholds are public: temper/regularity.hpp.
#pragma once

#include "temper/regularity.hpp"
