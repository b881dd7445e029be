// SPDX-License-Identifier: BSD-3-Clause
// Symbol visibility: everything is hidden but what carries this mark.
#pragma once

#define PCL_UVOL_EXPORTS __attribute__((visibility("default")))
