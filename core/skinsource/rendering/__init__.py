"""The engine: from drives and responses to levels and traces, doing only what a scene needs.

Everything here is a pure function of its arguments; what is remembered only saves time.
"""
