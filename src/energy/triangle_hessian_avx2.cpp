#include "energy/triangle_hessian_set.hpp"
