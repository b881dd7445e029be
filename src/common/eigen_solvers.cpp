// SPDX-License-Identifier: BSD-3-Clause
#include "common/eigen_solvers.h"

PCL_UVOL_EIGEN_SOLVERS()
