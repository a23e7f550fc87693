"""The messages and stubs as they are, generated from `proto/sinew/v1`; `sinew` is built on them.

Their documentation (units, frames, ranges, defaults) is in the `.pyi` beside each module.
"""
