# The console's typefaces, made of Debian's; gives their files as console_faces. At run time none of Debian's is needed.
function(liena_has_font_tools result python)
  execute_process(COMMAND "${python}" -c "import fontTools.subset" RESULT_VARIABLE status OUTPUT_QUIET ERROR_QUIET)
  if(NOT status EQUAL 0)
    set(${result} FALSE PARENT_SCOPE)
  endif()
endfunction()

find_program(LIENA_FONT_PYTHON NAMES python3 HINTS /usr/bin VALIDATOR liena_has_font_tools)
find_path(LIENA_INTER Inter-Regular.otf PATHS /usr/share/fonts/opentype/inter)
find_file(LIENA_MICRO_HEI wqy-microhei.ttc PATHS /usr/share/fonts/truetype/wqy)
foreach(what "LIENA_FONT_PYTHON;a python3 with fontTools;python3-fonttools" "LIENA_INTER;Inter-Regular.otf;fonts-inter"
    "LIENA_MICRO_HEI;wqy-microhei.ttc;fonts-wqy-microhei")
  list(GET what 0 place)
  list(GET what 1 thing)
  list(GET what 2 package)
  if(NOT ${place})
    message(FATAL_ERROR "The console's typefaces are made with ${thing}, which is not on this computer: install the package ${package} "
      "(packaging/install-dependencies does), or say where it is with -D${place}=")
  endif()
endforeach()

set(console_faces "")
function(liena_make_face kind from to)
  set(script "${PROJECT_SOURCE_DIR}/resources/fonts/make_face.py")
  set(face "${CMAKE_CURRENT_BINARY_DIR}/fonts/${to}")
  add_custom_command(OUTPUT "${face}" DEPENDS "${script}" "${from}" COMMENT "Making ${to}" VERBATIM
    COMMAND "${CMAKE_COMMAND}" -E make_directory "${CMAKE_CURRENT_BINARY_DIR}/fonts"
    COMMAND "${LIENA_FONT_PYTHON}" "${script}" ${kind} "${from}" "${face}")
  set(console_faces ${console_faces} "${face}" PARENT_SCOPE)
endfunction()
foreach(weight Regular Medium SemiBold Bold) # those of widgets/theme.cpp
  liena_make_face(sans "${LIENA_INTER}/Inter-${weight}.otf" LiENaSans-${weight}.otf)
endforeach()
liena_make_face(hei "${LIENA_MICRO_HEI}" LiENaHei-Regular.ttf)

# What came with them goes with what is made of them.
foreach(package fonts-inter fonts-wqy-microhei)
  set(licence "/usr/share/doc/${package}/copyright")
  if(EXISTS "${licence}")
    install(FILES "${licence}" DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/liena/licences RENAME ${package})
  else()
    message(WARNING "${licence} is missing: what is installed has not the licence of its typefaces; install the package ${package} whole before you hand it on")
  endif()
endforeach()
