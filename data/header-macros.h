#include <stdint.h>

#ifdef __AVR__
#include <avr/pgmspace.h>
#endif
#ifndef PROGMEM
#define PROGMEM
#endif
#ifdef __GNUC__
#define STIM_UNUSED __attribute__((unused))
#else
#define STIM_UNUSED
#endif
