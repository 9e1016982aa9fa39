# A mistake in memory is hard to use: all that is linked is bound when it is loaded, and its tables are read-only from
# then on; a function's return address is guarded, its frame never jumps a guard page, and the C library's functions that
# write know how large their target is. Of the engine and of the Python module.
add_link_options(-Wl,-z,relro,-z,now)
add_compile_options(-fstack-protector-strong -fstack-clash-protection)
if(NOT STAMPEDE_SANITIZE)  # sanitizers watch the same functions themselves
  add_compile_options($<$<CONFIG:Release>:-U_FORTIFY_SOURCE> $<$<CONFIG:Release>:-D_FORTIFY_SOURCE=3>)
endif()
