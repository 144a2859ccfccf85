"""A small language for signals: ``sin(2*pi*100*t) * hann()``.

It has numbers, ``t`` (s, 0 at the start), ``duration`` (s), ``pi``; ``+ - * / ^`` and brackets as
in mathematics, so that ``-t^2`` is below zero and ``2^3^2`` is 512; comparisons, which are 1 or 0;
and functions (`skinsource.signals.formula.reading`).  Python never evaluates a text, and no text
takes long, because its length, its nesting and its steps are limited.

`skinsource.signals.formula.reading.read` turns a text into a program, its tree in postfix order;
`skinsource.signals.formula.reading.played` computes its samples.
"""
