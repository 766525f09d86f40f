// Inlines everything a hot kernel calls. Not under the sanitizers, whose checks in one function of
// that size would keep the compiler busy for a quarter of an hour.
#pragma once

#ifdef __SANITIZE_ADDRESS__
#define CW_FLATTEN
#else
#define CW_FLATTEN [[gnu::flatten]]
#endif
