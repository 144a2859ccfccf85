"""Error against run time of this program and of others, as ``skinsource bench`` measures them.

Each way of computing is compared with the exact values of each case: a new way is one more entry in
`skinsource.studies.accuracy.measuring.WAYS`, a new case one more in
`skinsource.studies.accuracy.cases`.
"""
